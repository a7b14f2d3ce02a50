/// Period, decrement and mean of sampled oscillations against what they were made of.

#include "common/run/oscillation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace diptych::run {
namespace {

struct Signal {
  std::vector<double> times, values;
  Signal(double end, int n, const std::function<double(double)>& f) {
    for (int i = 0; i <= n; ++i) {
      times.push_back(end * i / n);
      values.push_back(f(times.back()));
    }
  }
  std::optional<Oscillation> oscillation() const { return oscillation_of(times, values); }
};

constexpr double period = 0.65, omega = 2 * 3.14159265358979 / period;

TEST(Oscillation, OfAShiftedCosineIsFoundToTheErrorOfTheSampling) {
  const auto found =
      Signal(3, 300, [](double t) { return 1.4 * (1 - std::cos(omega * t)); }).oscillation();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->n_periods, 4);  // upward at 1/4, 5/4 ... 17/4 of a period
  // linear interpolation at crossings: (omega dt)^2/8 of dt at most
  EXPECT_NEAR(found->period, period, 2e-4 * period);
  EXPECT_NEAR(found->mean, 1.4, 1e-3);
  EXPECT_NEAR(found->amplitude, 1.4, 1e-3);
  ASSERT_TRUE(found->decrement);
  EXPECT_NEAR(*found->decrement, 0, 1e-3);
}

TEST(Oscillation, OfADampedSineHasItsDecrementAndItsRest) {
  for (const double delta : {-0.2, 0.2, 0.5, 0.65, 0.82}) {
    const auto found = Signal(4, 4000, [&](double t) {
                         return 3 + std::exp(-delta * t / period) * std::sin(omega * t + 1);
                       }).oscillation();
    ASSERT_TRUE(found && found->decrement);
    EXPECT_NEAR(*found->decrement, delta, 1e-3);
    EXPECT_NEAR(found->period, period, 1e-4 * period) << delta << ": 7e-3 about the mean";
    EXPECT_NEAR(found->mean, 3, 1e-3);
  }
}

TEST(Oscillation, OfOneDampedPeriodComesToRestWhereItsExtremesSay) {
  for (const double delta : {0.1, 0.5, 0.82}) {
    const auto found = Signal(2.3 * period, 2000, [&](double t) {
                         return 3 + std::exp(-delta * t / period) * std::sin(omega * t);
                       }).oscillation();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->n_periods, 1);
    EXPECT_NEAR(found->period, period, 1e-4 * period) << "3 % about the mean of the period";
    EXPECT_NEAR(found->mean, 3, 1e-4);
  }
}

TEST(Oscillation, RipplesAreNoPeriods) {
  const auto found = Signal(3, 3000, [](double t) {
                       return std::sin(omega * t) + 0.05 * std::sin(23 * omega * t);
                     }).oscillation();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->n_periods, 3);
  EXPECT_NEAR(found->period, period, 0.01 * period);
}

TEST(Oscillation, IsAbsentWithoutAWholePeriod) {
  EXPECT_FALSE(Signal(0.6, 100, [](double t) { return std::sin(omega * t); }).oscillation());
  EXPECT_FALSE(Signal(1, 100, [](double) { return 2.0; }).oscillation());
  EXPECT_FALSE(oscillation_of({}, {}));
}

}  // namespace
}  // namespace diptych::run
