#include "postprocess/report/line_plot.hpp"

#include "common/base/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace diptych::report {
namespace {

using testing::HasSubstr;

TEST(RoundTicks, SpanTheDataInRoundSteps) {
  EXPECT_THAT(round_ticks(0, 10), testing::ElementsAre(0, 2, 4, 6, 8, 10));
  const auto ticks = round_ticks(-0.37, 1.91);
  EXPECT_LE(ticks.front(), -0.37);
  EXPECT_GE(ticks.back(), 1.91);
  EXPECT_LE(ticks.size(), 9u);
  EXPECT_GE(round_ticks(5, 5).size(), 2u) << "a constant has a range too";
  EXPECT_GE(round_ticks(0, 0).size(), 2u);
}

TEST(SvgPlot, HoldsEveryCurveInsideThePicture) {
  const std::string svg = svg_plot(
      "a < b", {{"p", "x", "y", {{"one", {0, 1, 2}, {1e6, 3e6, -2e6}}, {"", {0, 2}, {0, 0}}}}});
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, HasSubstr(">one</text>"));
  size_t n_curves = 0;
  for (size_t at = svg.find("<polyline"); at != std::string::npos;
       at = svg.find("<polyline", at + 1))
    ++n_curves;
  EXPECT_EQ(n_curves, 2u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

TEST(SvgPlot, LeavesOutWhatIsNotFiniteAndRefusesNothingAtAll) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(svg_plot("t", {{"p", "x", "y", {{"", {0, 1, 2}, {0, nan, 1}}}}}).find("nan"),
            std::string::npos);
  EXPECT_THROW(svg_plot("t", {{"p", "x", "y", {{"", {0}, {nan}}}}}), base::InputError);
}

TEST(LogarithmicTicks, SpanTheValuesWithRoundOnes) {
  const auto powers = [](const std::vector<double>& ticks) {
    std::vector<double> values;
    for (const double tick : ticks)
      values.push_back(std::pow(10, tick));
    return values;
  };
  using testing::DoubleNear;
  EXPECT_THAT(powers(logarithmic_ticks(-3.5, 0.2)),
              testing::Pointwise(DoubleNear(1e-9), {1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0}));
  EXPECT_THAT(powers(logarithmic_ticks(std::log10(3.0), std::log10(30.0))),
              testing::Pointwise(DoubleNear(1e-9), {2.0, 5.0, 10.0, 20.0, 50.0}));
  EXPECT_GE(logarithmic_ticks(1, 1).size(), 2u);
}

}  // namespace
}  // namespace diptych::report
