/// Numerical dissipation: never negative, step by step and, with the sign-preserving limiter, pair
/// by pair; and small against the physical dissipation, ever more so under refinement.

#include "common/scheme/dissipation/dissipation.hpp"

#include "tests/verification/case_scene.hpp"

#include <gtest/gtest.h>

#include <random>

namespace diptych {
namespace {

using algebra::Lanes;
using algebra::Vector;
using tests::Scene;
using tests::scene_of_case;

struct Dissipated {
  double numerical = 0, physical = 0;
  int negative_steps = 0;
};

Dissipated dissipated_by(run::Solver& solver, double end, double rounding) {
  Dissipated sum;
  while (solver.time() < end) {
    solver.step(end);
    const scheme::Audit& audit = solver.audit();
    if (!(audit.numerical_dissipation >= sum.numerical)) ++sum.negative_steps;
    // a relaxed branch at rest dissipates 0 as 6 - 6: rounding against energies of strain 1
    if (!(audit.viscous_dissipation >= sum.physical - rounding)) ++sum.negative_steps;
    sum = {audit.numerical_dissipation, audit.viscous_dissipation, sum.negative_steps};
  }
  return sum;
}

class Dissipation : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Both, Dissipation, testing::Values("sph", "fvm"));

TEST_P(Dissipation, NumericalOverPhysicalFallsAtOrderTwoAndMore) {
  struct Levels {
    const char* name;
    int first;
    const char* kappa;
    double most;  ///< ratio at the third level: measured without correction, plus a tenth
  };
  for (const auto& [name, first, kappa, most] :
       {Levels{"swinging-cube-ve2-hex", 0, "sph.kappa=1", 5.1e-3},
        Levels{"shear-wave-plane-ve2", 1, "sph.kappa=0.75", 6.3e-4}}) {
    for (const char* correction : {"0", "\"1/6\""}) {
      double ratio[3];
      for (int k = 0; k < 3; ++k) {
        Scene scene = scene_of_case(
            GetParam(), name,
            {"time.integrator=\"ssp-rk3\"", std::string("scheme.face_correction=") + correction,
             "sph.gradient=corrected", "fvm.stencil=edge", kappa},
            first + k);
        const Dissipated sum = dissipated_by(*scene.solver, scene.setup.time.end, 1e-15 * 17e6);
        EXPECT_EQ(sum.negative_steps, 0) << name;
        ratio[k] = sum.numerical / sum.physical;
      }
      // asked 1.5; 2.7 to 3.0: jumps of the reconstruction are O(h^2), |S| O(h^2), pairs O(h^-3)
      EXPECT_GE(std::log2(ratio[0] / ratio[1]), 2.6) << name << ' ' << correction;
      EXPECT_GE(std::log2(ratio[1] / ratio[2]), 2.8) << name << ' ' << correction;
      EXPECT_LE(ratio[2], most) << name << ' ' << correction;
    }
  }
}

/// Of operators that sum by parts the sign is not that of every pair (notes 4.3, 4.4): with linear
/// reconstructions it is that of the sum, and what it takes falls faster than the error. With the
/// quartic ones of the default less than a hundredth of what second order takes is left.
TEST_P(Dissipation, OfTheDefaultsIsAHundredthOfThatOfSecondOrder) {
  for (const char* name : {"swinging-cube-ve2-hex", "shear-wave-plane-ve2"}) {
    SCOPED_TRACE(name);
    const auto share = [&](const std::vector<std::string>& operators, int level) {
      std::vector<std::string> set{"time.integrator=\"ssp-rk3\""};
      set.insert(set.end(), operators.begin(), operators.end());
      Scene scene = scene_of_case(GetParam(), name, set, level);
      const Dissipated sum = dissipated_by(*scene.solver, scene.setup.time.end, 1e-15 * 17e6);
      return sum.numerical / sum.physical;
    };
    const std::vector<std::string> linear{"scheme.reconstruction=linear"};
    const double coarse = share(linear, 1), fine = share(linear, 2);
    EXPECT_GT(fine, 0);
    EXPECT_GE(std::log2(coarse / fine), 2.3);
    const double second = share({"sph.gradient=corrected", "fvm.stencil=edge"}, 2);
    EXPECT_LE(fine, second);
    const double quartic = share({}, 2);
    EXPECT_GT(quartic, 0);
    EXPECT_LE(quartic, 0.01 * second) << second;
  }
}

/// Node to node noise on a body under way: nothing is smooth here.
TEST_P(Dissipation, IsNotNegativeInAnyStepOfARoughMotion) {
  const std::string noisy = std::string(tests::spinning_cube)
                                .replace(std::string(tests::spinning_cube).find("-105*y"), 6,
                                         "40*sin(91*x+57*y*y+33*z)-105*y");
  for (const char* limiter : {"none", "sign-preserving"}) {
    for (const char* integrator : {"leapfrog", "ssp-rk3"}) {
      parallel::set_threads(1);
      Scene scene = tests::scene_of(GetParam(), noisy,
                                    {tests::text_of("scheme.limiter", limiter),
                                     tests::text_of("time.integrator", integrator)});
      const Dissipated sum = dissipated_by(*scene.solver, 4e-3, 0);
      EXPECT_GT(sum.numerical, 0);
      EXPECT_EQ(sum.negative_steps, 0) << limiter << ' ' << integrator;
    }
  }
}

// (v_b - v_a) . Z limited >= 0 for any reconstructed jump, in space and in the plane.
template <int Dim>
void expect_every_pair_to_dissipate() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int n_limited = 0;
  for (int n = 0; n < 20000; ++n) {
    Vector<Lanes> plain{}, jump{}, h{};
    for (int i = 0; i < Dim; ++i) {
      for (int l = 0; l < algebra::n_lanes; ++l) {
        plain[i][l] = uniform(random);
        jump[i][l] = plain[i][l] + 1.5 * uniform(random);
        h[i][l] = uniform(random);
      }
    }
    Lanes h_h{};
    for (int i = 0; i < Dim; ++i)
      h_h += h[i] * h[i];
    Vector<Lanes> normal{};
    for (int i = 0; i < Dim; ++i)
      normal[i] = h[i] / algebra::square_root(h_h);
    const Vector<Lanes> before = jump;
    scheme::limit_sign_preserving<Dim>(jump, plain, normal);
    const auto D = scheme::isotropic_impedance_times<Dim>(Lanes{} + 2.0, Lanes{} + 1.0, h, jump);
    for (int l = 0; l < algebra::n_lanes; ++l) {
      double power = 0, size = 0, change = 0;
      for (int i = 0; i < Dim; ++i) {
        power += plain[i][l] * D[i][l];
        size += std::abs(plain[i][l] * D[i][l]);
        change += std::abs(jump[i][l] - before[i][l]);
      }
      n_limited += change > 1e-12 ? 1 : 0;
      ASSERT_GE(power, -1e-14 * size);
    }
  }
  EXPECT_GT(n_limited, 10000);
}

TEST(SignPreservingLimiter, MakesEveryPairDissipate) {
  expect_every_pair_to_dissipate<3>();
  expect_every_pair_to_dissipate<2>();
}

}  // namespace
}  // namespace diptych
