/// Manufactured solutions at large strain: observed orders between two small levels, caps on the
/// errors (measured when the cases were made, plus a tenth), and the energy residual, both methods.
/// The orders that finer levels reach are in the README of each case.

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/study/study.hpp"
#include "common/cases/reader.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

struct Expectation {
  const char* name;
  const char* boundary;  ///< velocity or traction
  const char* method;
  double least_order_u, least_order_v, least_order_P;
  double most_u, most_v, most_P;  ///< relative L2 errors at the finer level
};

void PrintTo(const Expectation& e, std::ostream* out) {
  *out << e.name << " " << e.boundary << " " << e.method;
}

/// Coarse to fine. @param set  beside the boundary and the size
std::vector<io::RunSummary> runs_of(const Expectation& e,
                                    const std::vector<int>& levels,
                                    const std::vector<std::string>& set = {}) {
  const bool solid = std::string(e.name).find("3d") != std::string::npos;
  std::vector<std::string> overrides{std::string("boundary.0.type=") + e.boundary,
                                     solid ? "mesh.cells=[6, 6, 6]" : "mesh.cells=[14, 14]",
                                     "output.frames=2"};
  overrides.insert(overrides.end(), set.begin(), set.end());
  const auto setup = cases::read_case(harness::find_case(e.name), overrides);
  harness::StudyOptions options;
  options.methods = {e.method};
  options.levels = levels;
  options.threads = 1;
  options.quiet = true;
  return harness::run_study(setup, options).runs;
}

class Manufactured : public testing::TestWithParam<Expectation> {};

TEST_P(Manufactured, Converges) {
  const Expectation& e = GetParam();
  const auto runs = runs_of(e, {0, 1});
  const auto order = [&](const char* field) {
    return std::log2(runs[0].errors.at(field).l2 / runs[1].errors.at(field).l2);
  };

  EXPECT_GE(order("displacement"), e.least_order_u);
  EXPECT_GE(order("velocity"), e.least_order_v);
  EXPECT_GE(order("stress"), e.least_order_P);
  EXPECT_LE(runs[1].errors.at("displacement").l2, e.most_u);
  EXPECT_LE(runs[1].errors.at("velocity").l2, e.most_v);
  EXPECT_LE(runs[1].errors.at("stress").l2, e.most_P);
  for (const char* field : {"deformation_gradient", "cofactor", "jacobian"})
    EXPECT_GE(order(field), std::min(e.least_order_P, 2.0) - 0.4) << field;
  const bool has_branch = std::string(e.name).find("elastic") == std::string::npos;
  for (const char* field : {"viscous_C", "viscous_G"}) {
    ASSERT_EQ(runs[1].errors.count(field), has_branch ? 1U : 0U);
    if (has_branch) {
      EXPECT_GE(order(field), 1.1) << field;
    }
  }
  // Work of the body force, of tractions and of moving boundaries enters the budget: what is left
  // is the error of the time integration, third order in dt: up to 8.2e-5 at the default step.
  const auto fine_steps = runs_of(e, {1}, {"time.cfl=0.8"});
  EXPECT_LE(std::abs(fine_steps[0].energy.relative_residual), 2e-5);
  EXPECT_LE(std::abs(runs[1].energy.relative_residual), 1e-4);
  EXPECT_GT(std::abs(runs[1].energy.external_work), 0.09 * runs[1].energy.kinetic);
}

INSTANTIATE_TEST_SUITE_P(
    Cases,
    Manufactured,
    testing::Values(Expectation{"manufactured-swirl-2d", "velocity", "sph", 1.8, 2.1, 1.8, 2.42e-02,
                                1.17e-02, 2.76e-02},
                    Expectation{"manufactured-swirl-2d", "velocity", "fvm", 1.9, 2.1, 1.9, 1.57e-02,
                                6.14e-03, 1.76e-02},
                    Expectation{"manufactured-swirl-2d", "traction", "sph", 1.9, 1.6, 1.9, 2.08e-02,
                                1.51e-02, 2.54e-02},
                    Expectation{"manufactured-swirl-2d", "traction", "fvm", 1.9, 1.8, 1.9, 1.60e-02,
                                7.92e-03, 1.78e-02},
                    Expectation{"manufactured-swirl-2d-elastic", "velocity", "sph", 1.7, 1.9, 1.8,
                                2.15e-02, 1.44e-02, 2.82e-02},
                    Expectation{"manufactured-swirl-2d-elastic", "traction", "fvm", 1.8, 2.0, 1.8,
                                1.51e-02, 8.25e-03, 1.80e-02},
                    Expectation{"manufactured-wave-3d", "velocity", "sph", 1.45, 1.85, 1.55,
                                6.33e-03, 1.13e-02, 2.31e-02},
                    Expectation{"manufactured-wave-3d", "velocity", "fvm", 1.5, 1.95, 1.75,
                                3.73e-03, 6.31e-03, 1.01e-02},
                    Expectation{"manufactured-wave-3d", "traction", "sph", 1.75, 1.75, 1.45,
                                9.61e-03, 1.83e-02, 2.57e-02},
                    Expectation{"manufactured-wave-3d", "traction", "fvm", 1.95, 2, 1.75, 2.85e-03,
                                4.80e-03, 7.59e-03},
                    Expectation{"manufactured-wave-3d-elastic", "velocity", "fvm", 1.3, 1.8, 1.8,
                                3.37e-03, 6.73e-03, 9.83e-03},
                    Expectation{"manufactured-wave-3d-elastic", "traction", "sph", 1.75, 1.75, 1.45,
                                8.62e-03, 1.73e-02, 2.38e-02}));

// The residual of the budget falls with the third power of the step.
TEST(ManufacturedEnergy, BudgetClosesAtTheOrderOfTheIntegrator) {
  for (const char* boundary : {"velocity", "traction"}) {
    double residual[2];
    for (const int k : {0, 1}) {
      const auto setup = cases::read_case(
          harness::find_case("manufactured-swirl-2d"),
          {std::string("boundary.0.type=") + boundary, k == 0 ? "time.cfl=0.8" : "time.cfl=0.4"});
      harness::RunOptions options;
      options.method = "fvm";
      options.threads = 1;
      options.quiet = true;
      options.level = 1;
      residual[k] = std::abs(run_case(setup, options).summary.energy.relative_residual);
    }
    EXPECT_GE(std::log2(residual[0] / residual[1]), 2.5) << boundary << ": " << residual[1];
  }
}

}  // namespace
}  // namespace diptych
