/// H and J as unknowns of their own (18c,d): that they are cof F and det F at the end of every
/// step, also after a thousand turns of a stiff body, that the run logs it, and that the unknowns
/// F, FJ, FHJ give one answer up to the error of the integrator.

#include "benchmarks/run/run_case.hpp"
#include "tests/verification/case_scene.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

using tests::Scene;
using tests::text_of;

class Involutions : public testing::TestWithParam<const char*> {
 protected:
  /// The cube of scenes.hpp, strained, after n equal steps.
  std::unique_ptr<Scene> after(int n,
                               const std::string& integrator,
                               const std::string& unknowns) const {
    parallel::set_threads(1);
    auto scene = std::make_unique<Scene>(
        GetParam(), cases::case_from_text(tests::spinning_cube, "scene",
                                          {tests::any_step, text_of("time.integrator", integrator),
                                           text_of("scheme.unknowns", unknowns)}));
    tests::make_steps(*scene->solver, 1e-3, n);
    return scene;
  }
};
INSTANTIATE_TEST_SUITE_P(Both, Involutions, testing::Values("sph", "fvm"));

TEST_P(Involutions, HoldToRoundingAtTheEndOfEveryStep) {
  for (const char* integrator : {"ssp-rk2", "ssp-rk3", "ssp-rk43", "leapfrog"}) {
    const auto strained = after(16, integrator, "FHJ")->solver->balance();
    EXPECT_LE(strained.involution_H, 1e-13) << integrator;
    EXPECT_LE(strained.involution_J, 1e-13) << integrator;
    EXPECT_LE(after(16, integrator, "FJ")->solver->balance().involution_J, 1e-13) << integrator;
    EXPECT_EQ(after(16, integrator, "F")->solver->balance().involution_H, 0);
  }
}

/// A cube of steel that spins with rims at 500 m/s.
const std::string steel = R"(
[mesh]
element = "hexahedron"
lower = [-0.5, -0.5, -0.5]
upper = [0.5, 0.5, 0.5]
cells = [2, 2, 2]
[material]
model = "mooney-rivlin"
density = 7800
youngs_modulus = 210e9
poissons_ratio = 0.3
zeta_ratio = 0.4
[initial]
velocity = ["-omega*y", "omega*x", 0]
[parameters]
omega = 1000
[scheme]
angular_momentum_projection = true
[time]
end = "1000*2*pi/omega"
)";

// H and J that were evolved from start to end drifted by 7e-3 in a few hundred turns, and the
// strain energy became negative.
TEST_P(Involutions, HoldThroughAThousandTurnsOfAStiffBody) {
  parallel::set_threads(1);
  Scene scene = tests::scene_of(GetParam(), steel, {"time.integrator=\"ssp-rk3\""});
  double strain = 1e300, drift = 0;
  for (int k = 1; k <= 100; ++k) {
    tests::run_to(*scene.solver, scene.setup.time.end * k / 100);
    const scheme::Balance now = scene.solver->balance();
    strain = std::min(strain, now.strain);
    drift = std::max({drift, now.involution_H, now.involution_J});
  }
  EXPECT_LE(drift, 1e-13);
  EXPECT_GT(strain, 0);
}

/// Largest distance of F and of P between two sets of unknowns.
std::pair<double, double> gap(const Scene& one, const Scene& other) {
  const auto a = one.solver->snapshot(), b = other.solver->snapshot();
  double F = 0, P = 0;
  for (size_t k = 0; k < a.F.size(); ++k) {
    F = std::max(F, (a.F[k] - b.F[k]).norm());
    P = std::max(P, (a.P[k] - b.P[k]).norm());
  }
  return {F, P};
}

// They differ within steps alone, by what the stages make of H and J.
TEST_P(Involutions, UnknownsGiveOneAnswerUpToTheIntegrator) {
  for (const auto& [integrator, order] : {std::pair{"ssp-rk2", 1.9}, std::pair{"ssp-rk3", 2.8}}) {
    const auto coarse = after(16, integrator, "FHJ"), fine = after(32, integrator, "FHJ");
    for (const char* unknowns : {"F", "FJ"}) {
      const auto fewer = after(32, integrator, unknowns);
      EXPECT_LT(fewer->solver->unknowns_per_node(), fine->solver->unknowns_per_node());
      const auto [F_coarse, P_coarse] = gap(*after(16, integrator, unknowns), *coarse);
      const auto [F, P] = gap(*fewer, *fine);
      EXPECT_GE(std::log2(F_coarse / F), order) << integrator << ' ' << unknowns;
      EXPECT_GE(std::log2(P_coarse / P), order) << integrator << ' ' << unknowns;
      EXPECT_GT(F, 1e-12) << "nothing to converge: the test tests nothing";
    }
  }
  for (const char* unknowns : {"F", "FJ"}) {
    const auto [F, P] = gap(*after(32, "leapfrog", unknowns), *after(32, "leapfrog", "FHJ"));
    EXPECT_LE(F, 1e-12) << unknowns;
    EXPECT_LE(P, 1e-11 * 17e6) << unknowns;
  }
}

TEST_P(Involutions, AreInHistoryAndSummary) {
  harness::RunOptions options;
  options.method = GetParam();
  options.threads = 1;
  options.quiet = true;
  const auto result = run_case(
      cases::read_case(harness::find_case("spinning-cube"),
                       {"time.integrator=\"ssp-rk3\"", "mesh.cells=[3, 3, 3]", "output.frames=2",
                        "guards.energy_residual=0.1"}),  // three cells across: 3 %
      options);
  EXPECT_EQ(result.history.front().involution_H, 0);
  EXPECT_LT(result.history.back().involution_H, 1e-13);
  EXPECT_LT(result.history.back().involution_J, 1e-13);
  EXPECT_GE(result.summary.involution_H, result.history.back().involution_H);
  EXPECT_GE(result.summary.involution_J, result.history.back().involution_J);
}

}  // namespace
}  // namespace diptych
