/// Verdicts on a scalar of two methods: what is resolved, what is near without an order, and what
/// the orders of a run may be.

#include "postprocess/report/agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::report {
namespace {

/// c + a h^p on spacings 1/4, 1/8, 1/16.
ScalarOfMethod converging(const char* name, double c, double a, double p, FormalOrder formal = {}) {
  const double h[3] = {1. / 16, 1. / 8, 1. / 4};
  double f[3];
  for (int i = 0; i < 3; ++i)
    f[i] = c + a * std::pow(h[i], p);
  const GridConvergence estimate = grid_convergence(h, f);
  return {name, f[0], estimate.error_bar, estimate, formal};
}

ScalarOfMethod of_values(const char* name, double coarse, double medium, double fine) {
  const GridConvergence estimate = grid_convergence({1, 2, 4}, {fine, medium, coarse});
  return {name, fine, estimate.error_bar, estimate, {}};
}

TEST(AgreementOfMethods, IsAskedOfBarsWhereBothShowTheirOrder) {
  const ScalarOfMethod a = converging("SPH", 10, 3, 2);
  // bars 1.25 * 3/256 = 0.0146 each
  const Verdict within = verdict_on(a, converging("FVM", 10.029, 3, 2), 10);
  EXPECT_EQ(within.agreement, Agreement::agree);
  EXPECT_NEAR(within.allowed, 2 * 1.25 * 3 / 256, 1e-12);
  EXPECT_EQ(verdict_text(within), "agree");
  const Verdict beyond = verdict_on(a, converging("FVM", 10.03, 3, 2), 10);
  EXPECT_EQ(beyond.agreement, Agreement::apart);
  EXPECT_EQ(verdict_text(beyond), "APART");
}

TEST(AgreementOfMethods, LetsAnOrderLieBetweenThoseOfTimeAndOfSpace) {
  const ScalarOfMethod b = converging("FVM", 10, 2, 2);
  const auto verdict_with = [&](double order, FormalOrder formal) {
    return verdict_text(verdict_on(converging("SPH", 10, 2, order, formal), b, 10));
  };
  for (const double order : {1.6, 2.0, 2.5, 3.0, 3.4})
    EXPECT_EQ(verdict_with(order, {2, 3}), "agree") << order;
  EXPECT_EQ(verdict_with(3.7, {2, 3}), "unresolved, near: SPH shows order 3.7 (its own is 2 to 3)");
  EXPECT_EQ(verdict_with(2.0, {3, 3}), "unresolved, near: SPH shows order 2 (its own is 3)");
}

TEST(AgreementOfMethods, IsNearOrFarWhereThereIsNoOrderAndLevelsChangeByLittle) {
  const ScalarOfMethod a = of_values("SPH", 10, 10.1, 10.05);  // range 0.1: a bar of 0.3, 3 %
  const Verdict near = verdict_on(a, of_values("FVM", 10.2, 10.25, 10.24), 10);
  EXPECT_EQ(near.agreement, Agreement::near);
  EXPECT_NEAR(near.allowed, 3 * 0.1 + 3 * 0.05, 1e-12);
  EXPECT_EQ(verdict_text(near), "unresolved, near: each method oscillates");
  const Verdict far = verdict_on(a, of_values("FVM", 10.6, 10.65, 10.64), 10);
  EXPECT_EQ(verdict_text(far), "unresolved, far: each method oscillates");
  const Verdict wide = verdict_on(a, of_values("FVM", 10, 10.2, 10.1), 10);  // 0.6 of 10
  EXPECT_EQ(verdict_text(wide), "unresolved: each method oscillates");
}

TEST(AgreementOfMethods, NeedsThreeLevels) {
  const ScalarOfMethod a{"SPH", 1, 0.1, std::nullopt, {}};
  const Verdict verdict = verdict_on(a, of_values("FVM", 1, 1, 1), 1);
  EXPECT_EQ(verdict.agreement, Agreement::unresolved);
  EXPECT_EQ(verdict.why, "SPH has fewer than three levels");
}

TEST(AgreementOfMethods, HoldsOfValuesEqualInSixDigits) {
  EXPECT_EQ(
      verdict_on(of_values("SPH", 1, 1, 1), of_values("FVM", 1.0000005, 1.0000005, 1.0000005), 1)
          .agreement,
      Agreement::agree);
  EXPECT_EQ(verdict_on(of_values("SPH", 1, 1, 1), of_values("FVM", 1.00002, 1.00002, 1.00002), 1)
                .agreement,
            Agreement::apart);
}

TEST(FormalOrder, IsFromTheIntegratorsToTheOperators) {
  io::RunSummary run;
  run.integrator = "leapfrog";
  run.graph_operators = "edge stencil";
  EXPECT_EQ(formal_order(run).least, 2);
  EXPECT_EQ(formal_order(run).greatest, 2);
  run.graph_operators = "sums by parts, order 4";
  EXPECT_EQ(formal_order(run).least, 2);
  EXPECT_EQ(formal_order(run).greatest, 3);
  run.integrator = "ssp-rk3";
  EXPECT_EQ(formal_order(run).least, 3);
  run.graph_operators = "edge stencil";
  EXPECT_EQ(formal_order(run).least, 2);
}

}  // namespace
}  // namespace diptych::report
