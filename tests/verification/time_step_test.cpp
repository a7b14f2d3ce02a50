/// The time step of a run: speeds of the current state, and what shortens it
/// (scheme/time_step.hpp).

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/run_case.hpp"
#include "common/cases/reader.hpp"

#include <gtest/gtest.h>

namespace diptych::harness {
namespace {

io::RunSummary impact(const std::vector<std::string>& overrides) {
  RunOptions options;
  options.threads = 1;
  options.quiet = true;
  return run_case(cases::read_case(find_case("impact"), overrides), options).summary;
}

TEST(TimeStep, FollowsTheStiffeningBodyUnlessLinearised) {
  // 50 m/s compress the bar to 0.68 of its length, where waves are 1.22 times as fast
  const std::vector<std::string> strong{"parameters.v0=-50", "output.frames=1"};
  const auto with = [&](const std::string& speeds) {
    auto overrides = strong;
    overrides.push_back("time.speeds=" + speeds);
    return impact(overrides);
  };
  const auto exact = with("exact"), bound = with("bound"), linearised = with("linearised");
  EXPECT_LT(exact.dt_min, 0.85 * exact.dt_max);
  EXPECT_LE(bound.dt_min, exact.dt_min);
  EXPECT_GE(bound.dt_min, 0.9 * exact.dt_min) << "a bound, but a close one";
  EXPECT_NEAR(linearised.dt_min, exact.dt_max, 0.02 * exact.dt_max);
  EXPECT_GE(linearised.dt_min, 0.98 * linearised.dt_max) << "constant but for the last step";
}

TEST(TimeStep, StrongDissipationIsStableWithEveryIntegrator) {
  for (const char* integrator : {"leapfrog", "ssp-rk2", "ssp-rk3", "ssp-rk43"}) {
    for (const char* factor : {"1", "4"}) {
      const auto run = impact({std::string("time.integrator=") + integrator,
                               std::string("scheme.dissipation=") + factor, "output.frames=1"});
      // no heat comes from nothing: what the bar brought is kinetic, elastic or dissipated
      EXPECT_GE(run.energy.numerical_dissipation, 0) << integrator << ' ' << factor;
      EXPECT_LE(std::abs(run.energy.relative_residual), 0.02) << integrator << ' ' << factor;
    }
  }
}

}  // namespace
}  // namespace diptych::harness
