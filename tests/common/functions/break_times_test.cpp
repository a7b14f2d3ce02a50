/// Jumps of loads in time are found to the last bit, pulses that no sampling would see, too.

#include "common/functions/break_times.hpp"

#include <cmath>
#include <gmock/gmock.h>

namespace diptych::functions {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<double> breaks_of(const std::string& text, double end = 1) {
  return break_times({Expression(text, {}, {})}, 0, end).jumps;
}

double next(double t) {
  return std::nextafter(t, 2 * t);
}

TEST(BreakTimes, AreThoseOfComparisonsWithTime) {
  EXPECT_THAT(breaks_of("t < 0.5 ? 3 : 0"), ElementsAre(0.5));
  EXPECT_THAT(breaks_of("t <= 0.5 ? 3 : 0"), ElementsAre(next(0.5)));
  EXPECT_THAT(breaks_of("(t > 0.0501 && t < 0.0506) ? 1e5 : 0", 10),
              ElementsAre(next(0.0501), 0.0506));
  EXPECT_THAT(breaks_of("x*(t < 0.25) + y*(t < 0.125)"), ElementsAre(0.125, 0.25));
  EXPECT_THAT(breaks_of("1e-9*(2*t - 0.7) > 0 ? 1 : 0"),
              ElementsAre(testing::DoubleNear(0.35, 1e-15)));
}

TEST(BreakTimes, AreBothSidesOfAnInstantAlone) {
  EXPECT_THAT(breaks_of("t == 0.1 ? 1e6 : 0"), ElementsAre(0.1, next(0.1)));
  EXPECT_THAT(breaks_of("1e6*(2*t != 0.5)"), ElementsAre(0.25, next(0.25)));
  EXPECT_THAT(breaks_of("t == 0 ? 1 : sin(t)/t"), ElementsAre(std::nextafter(0.0, 1.0)));
}

TEST(BreakTimes, AreThoseOfPulsesBesideKinks) {
  EXPECT_THAT(
      breaks_of("abs(t - 0.3) < 1e-7 ? 1 : 0"),
      ElementsAre(testing::DoubleNear(0.3 - 1e-7, 1e-15), testing::DoubleNear(0.3 + 1e-7, 1e-15)));
  EXPECT_THAT(
      breaks_of("max(0, 1e-7 - abs(t - 0.3)) > 0 ? 1 : 0"),
      ElementsAre(testing::DoubleNear(0.3 - 1e-7, 1e-15), testing::DoubleNear(0.3 + 1e-7, 1e-15)));
  EXPECT_THAT(breaks_of("t < 1e9 ? 1 : 0", 1e-3), IsEmpty());
  EXPECT_THAT(breaks_of("t > 0.1 ? rint(3*sqrt(t - 0.1)) : 0"),
              ElementsAre(testing::DoubleEq(0.1), testing::DoubleEq(0.1),
                          testing::DoubleNear(0.1 + 1.0 / 36, 1e-12),
                          testing::DoubleNear(0.1 + 0.25, 1e-12),
                          testing::DoubleNear(0.1 + 25.0 / 36, 1e-12)));
}

TEST(BreakTimes, AreThoseOfWaves) {
  const auto breaks = breaks_of("sin(2*pi*5*t) > 0 ? 1 : -1");
  ASSERT_EQ(breaks.size(), 10U);  // at t = 0 and then every tenth
  for (size_t k = 1; k < breaks.size(); ++k)
    EXPECT_NEAR(breaks[k], 0.1 * static_cast<double>(k), 1e-12);
  EXPECT_EQ(breaks_of("sign(cos(2*pi*t))").size(), 2U);
  EXPECT_THAT(breaks_of("rint(t)"), ElementsAre(testing::DoubleEq(0.5)));
}

TEST(BreakTimes, AreThoseOfAngles) {
  EXPECT_THAT(breaks_of("atan2(sin(2*pi*2*t), cos(2*pi*2*t))"),
              ElementsAre(testing::DoubleNear(0.25, 1e-12), testing::DoubleNear(0.75, 1e-12)));
  EXPECT_THAT(breaks_of("atan2(t - 0.5, 1)"), IsEmpty());
  EXPECT_THAT(breaks_of("atan2(0, t - 0.5)"), testing::SizeIs(testing::Ge(1U)));
}

TEST(BreakTimes, AreNotOfWhatIsSmoothOrMovesThroughTheBody) {
  EXPECT_THAT(breaks_of("sin(t)*exp(-t) + abs(t - 0.5) + min(t, 0.3)"), IsEmpty());
  EXPECT_THAT(breaks_of("x < 3*t ? 1 : 0"), IsEmpty());
  EXPECT_THAT(breaks_of("x < 0.3 ? t : 0"), IsEmpty());
  EXPECT_THAT(breaks_of("t < 2 ? 1 : 0"), IsEmpty()) << "after the end";
}

TEST(InstantsAround, StandBeforeAndAtEachOfSomeBreaks) {
  const BreakTimes breaks{{2, 8}, {4}};
  EXPECT_THAT(instants_around(breaks, 0, 0.5, 9), ElementsAre(1, 2, 3, 4, 6, 8));
  EXPECT_THAT(instants_around(breaks, 0, 0.25, 2), ElementsAre(0.5, 2, 2.5, 4));
  EXPECT_TRUE(instants_around({}, 0, 0.5, 9).empty());
}

}  // namespace
}  // namespace diptych::functions
