/// The analytic ladder of benchmarks/cases on both methods: orders and caps of the error against
/// exact solutions. Caps are the measured errors with half as much on top; all runs are
/// deterministic, so what fails has changed.

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_check.hpp"
#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/run_case.hpp"
#include "common/cases/reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace diptych::harness {
namespace {

class Ladder : public testing::TestWithParam<const char*> {
 protected:
  RunResult run(const std::string& name,
                int level,
                const std::vector<std::string>& overrides = {}) const {
    RunOptions options;
    options.method = GetParam();
    options.level = level;
    options.threads = 1;
    options.quiet = true;
    const cases::Case setup = cases::read_case(find_case(name), overrides);
    return run_case(setup, options);
  }
  static double error(const RunResult& result, const std::string& field) {
    return result.summary.errors.at(field).l2;
  }
  static bool is_sph() { return std::string(GetParam()) == "sph"; }
};
INSTANTIATE_TEST_SUITE_P(Both, Ladder, testing::Values("sph", "fvm"));

TEST(Cases, AreSoundOnBothMethodsAndExplained) {
  const auto cases = listed_cases();
  EXPECT_GE(cases.size(), 22u);
  for (const auto& [name, file] : cases) {
    const cases::Case setup = cases::read_case(file);
    EXPECT_FALSE(setup.title.empty()) << name;
    const bool has_page =
        std::filesystem::exists(std::filesystem::path(setup.file).parent_path() / "README.md");
    EXPECT_TRUE(has_page || setup.expect.is_given) << name << " is explained by its page, or asks "
                                                   << "for its pass numbers";
    if (!setup.mesh.file.empty()) continue;  // meshed by gmsh, which may not be there
    for (const std::string& method : method_menu().names()) {
      const CaseCheck check = check_case(setup, method, 0, 0);
      EXPECT_GT(check.dt, 0) << name;
      // the rounding of least-squares solves on a few hundred nodes; others are near 1e-15
      EXPECT_LE(check.quality.closure, 1e-12) << name << ' ' << method;
    }
  }
}

TEST_P(Ladder, AffineMotionConvergesAtOrderThreeInTime) {
  // one frame: steps are not shortened on the way; order by the number of steps
  const auto coarse = run("affine-motion", 0, {"time.cfl=0.2", "output.frames=1"});
  const auto fine = run("affine-motion", 0, {"time.cfl=0.1", "output.frames=1"});
  const double ratio =
      static_cast<double>(fine.summary.steps) / static_cast<double>(coarse.summary.steps);
  for (const char* field : {"displacement", "deformation_gradient", "stress"}) {
    EXPECT_GE(std::log(error(coarse, field) / error(fine, field)) / std::log(ratio), 2.85) << field;
    EXPECT_LE(error(fine, field), 1.35e-8) << field;
  }
}

TEST_P(Ladder, AffineMotionHasNoErrorInSpace) {
  // Half the spacing halves the step: only an error free of 1/h falls at the order of time.
  // 1e-9 below is an error in time too: at this step
  const std::vector<std::string> step{"time.cfl=0.5"};
  const auto coarse = run("affine-motion", 0, step), fine = run("affine-motion", 1, step);
  const double steps =
      static_cast<double>(fine.summary.steps) / static_cast<double>(coarse.summary.steps);
  for (const char* field : {"displacement", "deformation_gradient", "stress"}) {
    const double order = std::log(error(coarse, field) / error(fine, field)) / std::log(steps);
    EXPECT_GE(order, 2.8) << field;
  }
  EXPECT_LE(error(fine, "velocity"), 1e-9) << "forced by the body force alone";
}

TEST_P(Ladder, AffineMotionUnderTractionConvergesInTime) {
  const auto coarse = run("affine-motion-traction", 0, {"time.cfl=0.4"});
  const auto fine = run("affine-motion-traction", 0, {"time.cfl=0.2"});
  EXPECT_GE(std::log2(error(coarse, "velocity") / error(fine, "velocity")), 2.7);
  EXPECT_GE(std::log2(error(coarse, "deformation_gradient") / error(fine, "deformation_gradient")),
            2.7);
}

TEST_P(Ladder, ShearWaveOfSeventyPercentConvergesAtOrderTwo) {
  // per halving of h; u and F come up to two from below (FVM 1.54, 1.43 one level coarser)
  const auto coarse = run("shear-wave-elastic", 1), fine = run("shear-wave-elastic", 2);
  const double ratio = coarse.summary.spacing / fine.summary.spacing;
  const auto order = [&](const char* field) {
    return std::log(error(coarse, field) / error(fine, field)) / std::log(ratio);
  };
  EXPECT_GE(order("velocity"), 1.9);
  EXPECT_GE(order("displacement"), 1.65);
  EXPECT_GE(order("deformation_gradient"), 1.55);
  EXPECT_LE(error(fine, "velocity"), is_sph() ? 1.45e-3 : 1.05e-3);
  EXPECT_LE(error(fine, "displacement"), is_sph() ? 7.2e-4 : 6.5e-4);
  EXPECT_LE(error(fine, "stress"), is_sph() ? 4.2e-3 : 3.1e-3);
}

TEST_P(Ladder, ViscoelasticShearWaveOfSeventyPercentConvergesAtOrderTwo) {
  const auto coarse = run("shear-wave-plane-ve2", 2), fine = run("shear-wave-plane-ve2", 3);
  const double ratio = coarse.summary.spacing / fine.summary.spacing;
  const auto order = [&](const char* field) {
    return std::log(error(coarse, field) / error(fine, field)) / std::log(ratio);
  };
  EXPECT_GE(order("velocity"), 1.9);
  EXPECT_GE(order("displacement"), 1.9);
  EXPECT_LE(error(fine, "velocity"), 2.2e-4);
  EXPECT_LE(error(fine, "displacement"), 8.5e-5);
  const auto solid = run("shear-wave-ve2", 1);
  EXPECT_LE(error(solid, "velocity"), 4.2e-3);
}

TEST_P(Ladder, PlaneWaveOfTheStandardLinearSolidConvergesAtOrderTwo) {
  const std::vector<std::string> plain{"sph.gradient=corrected", "sph.kappa=0.75",
                                       "fvm.stencil=edge"};
  const auto coarse = run("sls-wave", 1, plain), fine = run("sls-wave", 2, plain);
  const double ratio = coarse.summary.spacing / fine.summary.spacing;
  for (const char* field : {"velocity", "displacement", "stress"}) {
    EXPECT_GE(std::log(error(coarse, field) / error(fine, field)) / std::log(ratio), 1.8) << field;
    EXPECT_LE(error(fine, field), 8.5e-3) << field;
  }
  // The operators of the case, which sum by parts, are worth more than a level.
  const auto shipped = run("sls-wave", 1);
  EXPECT_LE(error(shipped, "velocity"), error(fine, "velocity"));
  EXPECT_LE(error(shipped, "displacement"), 0.6 * error(fine, "displacement"));
}

TEST_P(Ladder, SpinningCubeKeepsMomentumOverTenThousandSteps) {
  for (const char* name : {"spinning-cube", "spinning-cube-ve2"}) {
    const auto result =
        run(name, 0,
            {"time.end=100", "time.max_steps=10000", "output.frames=1000", "mesh.cells=[3, 3, 3]",
             "guards.numerical_dissipation=1"});  // so few cells lose half of it in 800 steps
    EXPECT_EQ(result.summary.steps, 10000) << name;
    EXPECT_LE(result.summary.linear_momentum_drift, 1e-13) << name;
    EXPECT_LE(result.summary.angular_momentum_drift, 1e-12) << name;
    // L_z = rho omega/6 of the cube, exact since volumes are for quadratics
    EXPECT_NEAR(result.history.front().angular_momentum[2], 1.925e4, 1) << name;
  }
}

/// Mean distance of the maxima of the strain energy, twice: the period.
double period_of(const std::vector<io::HistoryRow>& history) {
  std::vector<double> maxima;
  double largest = 0;
  for (const auto& row : history)
    largest = std::max(largest, row.energy.strain);
  for (size_t i = 1; i + 1 < history.size(); ++i) {
    const double a = history[i - 1].energy.strain, b = history[i].energy.strain,
                 c = history[i + 1].energy.strain;
    if (!(b >= a && b > c && b > 0.5 * largest)) continue;
    const double shift = 0.5 * (a - c) / (a - 2 * b + c);  // of the parabola through the three
    maxima.push_back(history[i].time + shift * (history[i + 1].time - history[i].time));
  }
  return 2 * (maxima.back() - maxima.front()) / static_cast<double>(maxima.size() - 1);
}

TEST_P(Ladder, VibratingBarKeepsItsPeriod) {
  const auto result = run("vibrating-bar", 0);
  // dispersion makes it longer: 0.098 % (SPH), 0.069 % (FVM) at h = 1/4
  EXPECT_NEAR(period_of(result.history), 0.1930640, is_sph() ? 2.5e-4 : 1.8e-4);
  EXPECT_GE(result.history.back().energy.kinetic, 0.99 * result.history.front().energy.kinetic);
}

}  // namespace
}  // namespace diptych::harness
