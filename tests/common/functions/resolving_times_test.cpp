/// Pulses and swings that steps would not see have ends of steps inside; what steps follow has
/// none.

#include "common/functions/resolving_times.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace diptych::functions {
namespace {

constexpr double dt = 1e-3;

struct Resolved {
  BreakTimes breaks;
  ResolvingTimes resolving;
};

Resolved resolved(const Expression& expression, double end = 0.1) {
  Resolved r;
  r.breaks = break_times({expression}, 0, end);
  r.resolving = resolving_times({expression}, r.breaks, 0, end, dt);
  return r;
}

/// By the trapezoidal rule with steps that end at jumps and at resolving times, no longer than dt.
double impulse(const std::string& text, double end = 0.1) {
  const Expression f(text, {}, {});
  const Resolved r = resolved(f, end);
  EXPECT_FALSE(r.resolving.are_too_many) << text;
  std::vector<double> ends = r.resolving.times;
  ends.insert(ends.end(), r.breaks.jumps.begin(), r.breaks.jumps.end());
  ends.push_back(end);
  std::sort(ends.begin(), ends.end());
  double sum = 0, t = 0;
  for (const double limit : ends) {
    while (t < limit) {
      const double step = (limit - t) / std::ceil((limit - t) / dt);
      const bool is_last = t + step >= limit * (1 - 1e-15);
      const double next = is_last ? limit : t + step;
      // just before a jump at its end
      const double before = is_last ? std::nextafter(limit, 0) : next;
      sum += 0.5 * (next - t) * (f({0, 0, 0}, t) + f({0, 0, 0}, before));
      t = next;
    }
  }
  return sum;
}

TEST(ResolvingTimes, KeepTheImpulseOfPulsesShorterThanAStep) {
  EXPECT_NEAR(impulse("t < 1e-3 ? sin(pi*t/1e-3)^2 : 0"), 0.5e-3, 0.01 * 0.5e-3);
  EXPECT_NEAR(impulse("(t > 0.0502 && t < 0.0503) ? sin(pi*(t - 0.0502)/1e-4) : 0"), 2e-4 / M_PI,
              0.01 * 2e-4 / M_PI);
  EXPECT_NEAR(impulse("max(0, 1 - abs(t - 0.05033)/1e-4)"), 1e-4, 0.01 * 1e-4);
  EXPECT_NEAR(impulse("max(0, 1 - abs(t - 0.05033)/1e-7)"), 1e-7, 0.01 * 1e-7);
  EXPECT_NEAR(impulse("(t > 0.0502 && t < 0.0504) ? 1 : 0"), 2e-4, 1e-12);
  EXPECT_NEAR(impulse("exp(-((t - 0.05033)/5e-4)^2)"), 5e-4 * std::sqrt(M_PI), 1e-2 * 5e-4);
}

TEST(ResolvingTimes, KeepTheMeanOfFastSwings) {
  for (const char* frequency : {"400", "800", "1000", "1199", "2000", "4000"}) {
    EXPECT_NEAR(impulse(std::string("sin(2*pi*") + frequency + "*t)^2"), 0.05, 0.01 * 0.05)
        << frequency;
    EXPECT_NEAR(impulse(std::string("sin(2*pi*") + frequency + "*t)", 0.1), 0, 1e-4);
  }
}

TEST(ResolvingTimes, AreNoneWhereStepsSeeAllThatHappens) {
  for (const char* text : {"3", "t", "sin(2*pi*50*t)", "t < 0.05 ? t : 0", "abs(t - 0.05)",
                           "min(1, t/0.02)", "tanh(50*(t - 0.05))", "x*sin(100*t)",
                           "sin(1e4*(x - t))", "(t > 0.0502 && t < 0.0732) ? 1 : 0"}) {
    EXPECT_THAT(resolved(Expression(text, {}, {})).resolving.times, testing::IsEmpty()) << text;
  }
}

TEST(ResolvingTimes, LookAtWhatEntersAnExpressionOfPlace) {
  EXPECT_THAT(resolved(Expression("x*sin(2*pi*400*t)", {}, {})).resolving.times,
              testing::Not(testing::IsEmpty()));
}

TEST(ResolvingTimes, AreTooManyOfWhatNoStepsCouldFollow) {
  EXPECT_TRUE(resolved(Expression("sin(2*pi*1e6*t)", {}, {})).resolving.are_too_many);
  EXPECT_FALSE(resolved(Expression("sin(2*pi*2e3*t)", {}, {})).resolving.are_too_many);
  const ResolvingTimes of_long_run = resolved(Expression("sin(2*pi*90*t)", {}, {}), 1000).resolving;
  EXPECT_FALSE(of_long_run.are_too_many) << "eleven steps a period, a million of them";
  EXPECT_TRUE(of_long_run.times.empty());
}

}  // namespace
}  // namespace diptych::functions
