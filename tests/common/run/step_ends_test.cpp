/// Where steps end because of what a case prescribes in time.

#include "common/run/step_ends.hpp"

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::HasSubstr;

cases::Case with(const std::string& boundary, const std::string& integrator = "leapfrog") {
  return cases::case_from_text(
      "[mesh]\ncells = [2, 2, 2]\n[material]\nmodel = \"neo-hookean\"\ndensity = 1000\n"
      "youngs_modulus = 1e6\npoissons_ratio = 0.3\n[[boundary]]\ngroup = \"z_max\"\n" +
          boundary + "[time]\nend = 0.1\nintegrator = \"" + integrator +
          "\"\n[output]\nframes = 10\n",
      "scene", {});
}

constexpr double dt = 1e-3;

std::vector<StepEnd> ends_of(const std::string& boundary,
                             const std::string& integrator = "leapfrog") {
  const std::vector<algebra::Vec3> places{{0, 0, 1},     {1, 0, 1},   {0.4, 0.7, 1},
                                          {0.2, 0.3, 1}, {0.8, 1, 1}, {0.6, 0.5, 1}};
  return step_ends(with(boundary, integrator), dt, places);
}

std::vector<StepEnd> jumps_of(const std::string& boundary) {
  std::vector<StepEnd> ends = ends_of(boundary);
  std::erase_if(ends, [](const StepEnd& end) { return !end.is_jump; });
  return ends;
}

TEST(StepEnds, AreBothSidesOfJumpsOfLoadsAndOfSupports) {
  for (const char* type : {"traction", "velocity"}) {
    const auto ends =
        jumps_of(fmt::format("type = \"{}\"\nvalue = [0, 0, \"t < 0.0251 ? 1 : 0\"]\n", type));
    ASSERT_EQ(ends.size(), 1U) << type;
    EXPECT_EQ(ends[0].before, std::nextafter(0.0251, 0));
    EXPECT_EQ(ends[0].after, 0.0251);
  }
}

TEST(StepEnds, AreInsideAPulseThatIsZeroAtBothEnds) {
  const auto ends = ends_of(
      "type = \"pressure\"\nvalue = \"(t > 0.0251 && t < 0.0253) ? sin(pi*(t - 0.0251)/2e-4) : "
      "0\"\n");
  ASSERT_GE(ends.size(), 9U);
  EXPECT_LE(ends.size(), 40U);
  int n_jumps = 0;
  for (size_t k = 0; k < ends.size(); ++k) {
    n_jumps += ends[k].before < ends[k].after ? 1 : 0;
    EXPECT_GE(ends[k].before, 0.0251);
    EXPECT_LE(ends[k].after, 0.0253);
    const double before = k > 0 ? ends[k - 1].after : 0;
    EXPECT_GT(ends[k].before, before);
  }
  EXPECT_EQ(n_jumps, 2);
}

/// Sixteen steps: none is longer than sqrt(16/50) of one.
TEST(StepEnds, AreCloseWhileALoadActsForSomeSteps) {
  const auto ends =
      ends_of("type = \"traction\"\nvalue = [0, 0, \"t > 0.04 && t < 0.056 ? 1 : 0\"]\n");
  ASSERT_EQ(ends.size(), 30U);
  EXPECT_EQ(ends.front().after, std::nextafter(0.04, 1)) << "before it nothing acts";
  for (size_t k = 1; k < ends.size(); ++k)
    EXPECT_NEAR(ends[k].before - ends[k - 1].after, 0.016 / 29, 1e-9);
  EXPECT_EQ(ends_of("type = \"traction\"\nvalue = [0, 0, \"t < 0.06 ? 1 : 0\"]\n").size(), 1U);
}

TEST(StepEnds, AreNotCloseWhereNothingSetsInAtOnce) {
  // it is zero at the jump, and other ends beside instants of output are no jumps
  const auto smooth = ends_of("type = \"pressure\"\nvalue = \"t < 0.03 ? sin(pi*t/0.03)^2 : 0\"\n");
  EXPECT_LE(smooth.size(), 2U);
  // next to nothing jumps
  const auto steady =
      ends_of("type = \"pressure\"\nvalue = \"1e3 + (sin(2*pi*t/0.002) > 0 ? 1e-9 : 0)\"\n");
  EXPECT_LE(steady.size(), 110U);
  EXPECT_EQ(steady.size(), jumps_of("type = \"pressure\"\nvalue = \"1e3 + (sin(2*pi*t/0.002) > 0 "
                                    "? 1e-9 : 0)\"\n")
                               .size());
}

/// The longest step between ends from `begin` to `end`.
double longest_of(const std::vector<StepEnd>& ends, double begin, double end) {
  double longest = 0, last = begin;
  for (const StepEnd& at : ends) {
    if (at.before <= begin) continue;
    longest = std::max(longest, std::min(at.before, end) - last);
    last = at.after;
    if (at.before >= end) return longest;
  }
  return std::max(longest, end - last);
}

/// Beside one jump, of what fades away or grows: for as long as its square over the largest.
TEST(StepEnds, AreCloseBesideAJumpOfALoadThatChanges) {
  const auto of_traction = [](const std::string& load, const std::string& integrator) {
    return ends_of("type = \"traction\"\nvalue = [0, 0, \"" + load + "\"]\n", integrator);
  };
  const auto fades = of_traction("t < 0.03 ? 0 : exp(-(t - 0.03)/2e-3)", "leapfrog");
  EXPECT_NEAR(fades.front().after, 0.03, 1e-15) << "before it nothing acts";
  EXPECT_NEAR(longest_of(fades, 0.03, 0.0365), dt / 8, 0.01 * dt) << "acts for one step";
  EXPECT_LT(fades.back().before, 0.038);
  EXPECT_LT(fades.back().before, fades.back().after) << "the next steps are those of a start";
  const auto grows = of_traction("t < 0.03 ? t/0.03 : 0", "leapfrog");
  EXPECT_NEAR(longest_of(grows, 0.0035, 0.03), dt * std::sqrt(10 / 50.), 0.01 * dt) << "for ten";
  EXPECT_GT(longest_of(grows, 0, 0.0035), 1.5 * dt) << "a thousandth of it";
  EXPECT_NEAR(grows.back().after, 0.03, 1e-15);
  // of a start, too
  const auto falls = of_traction("max(0, 1 - t/6e-3)", "leapfrog");
  EXPECT_NEAR(longest_of(falls, 0, 5e-3), dt * std::sqrt(2 / 50.), 0.01 * dt);
  // Runge-Kutta steps until the waves that the load has made have passed
  const auto rk = of_traction("t < 0.03 ? 0 : exp(-(t - 0.03)/2e-3)", "ssp-rk3");
  EXPECT_NEAR(longest_of(rk, 0.03, 0.0365), dt / 8, 0.01 * dt);
  EXPECT_NEAR(longest_of(rk, 0.038, 0.1), dt / 4, 0.01 * dt);
  // steps see these as they are
  EXPECT_TRUE(of_traction("exp(-t/0.2)", "leapfrog").empty());
  EXPECT_EQ(of_traction("t < 0.03 ? 0 : cos(100*(t - 0.03))", "ssp-rk3").size(), 1U);
}

TEST(StepEnds, BeginRightBehindAJumpAtTheStart) {
  const auto start = [](const std::string& value) {
    return start_of(with("type = \"velocity\"\nvalue = [0, 0, \"" + value + "\"]\n"));
  };
  for (const char* value : {"1", "t >= 0 ? 1 : 0", "t < 0.03 ? 1 : 0", "sin(t)", "min(1, t/1e-6)"})
    EXPECT_EQ(start(value), 0) << value;
  for (const char* value : {"t > 0 ? 1 : 0", "sign(t)", "sign(sin(2000*t))", "x*(t > 0 ? 0 : 5)"}) {
    EXPECT_GT(start(value), 0) << value;
    EXPECT_LT(start(value), 1e-14) << value;
  }
}

TEST(StepEnds, AreNoneWhereNothingHappensInAStep) {
  EXPECT_TRUE(ends_of("type = \"traction\"\nvalue = [0, 0, \"sin(300*t)\"]\n").empty());
  EXPECT_TRUE(ends_of("type = \"fixed\"\n").empty());
}

TEST(StepEnds, RefuseWhatNoStepsCouldFollow) {
  const auto setup = with("type = \"traction\"\nvalue = [0, 0, \"1e3*sin(2*pi*1e6*t)\"]\n");
  try {
    step_ends(setup, dt, {});
    ADD_FAILURE() << "not refused";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("1e3*sin(2*pi*1e6*t)"));
    EXPECT_THAT(error.what(), HasSubstr("changes so fast"));
  }
  EXPECT_NO_THROW(ends_of("type = \"traction\"\nvalue = [0, 0, \"sin(2*pi*500*t)\"]\n"));
}

TEST(StepEnds, AreWhereEachPlaceSeesItsPulse) {
  const auto ends = ends_of(
      "type = \"traction\"\nvalue = [0, 0, \"abs(t - (x < 0.45 ? 0.0251 : 0.0651)) < 1e-4 ? 1 : "
      "0\"]\n");
  for (const double jump : {0.025, 0.0252, 0.065, 0.0652}) {
    const bool is_there = std::any_of(ends.begin(), ends.end(), [jump](const StepEnd& end) {
      return std::abs(end.after - jump) < 1e-9 && end.before < end.after;
    });
    EXPECT_TRUE(is_there) << jump;
  }
  EXPECT_LE(ends.size(), 6U) << "two regions: nothing travels";
}

TEST(StepEnds, OfWhatTravelsAreCloseEnoughForNodesInBetween) {
  const auto ends =
      ends_of("type = \"pressure\"\nvalue = \"abs(x - 20*t + 0.1) < 2e-3 ? 1 : 0\"\n");
  // 0.2 ms at every place: six parts, from before the first place that is looked at to behind the
  // last
  double longest = 0;
  for (size_t k = 1; k < ends.size(); ++k)
    longest = std::max(longest, ends[k].before - ends[k - 1].after);
  ASSERT_GE(ends.size(), 1000U);
  EXPECT_LE(longest, 1.001 * 2e-4 / 6);
  EXPECT_LE(ends.front().after, 4.9e-3);
  EXPECT_GE(ends.back().after, 55.1e-3);
}

TEST(StepEnds, DoNotMindWhereAPulseActs) {
  const std::string everywhere =
      "type = \"pressure\"\nvalue = \"abs(t - 0.0251) < 1e-4 ? 1 : 0\"\n";
  const std::string somewhere =
      "type = \"pressure\"\nvalue = \"abs(t - 0.0251) < 1e-4 && x > 0.2 ? 1 : 0\"\n";
  EXPECT_EQ(jumps_of(everywhere).size(), 2U);
  EXPECT_EQ(jumps_of(somewhere).size(), 2U);
  EXPECT_EQ(ends_of(everywhere, "ssp-rk3").size(), ends_of(somewhere, "ssp-rk3").size());
  for (const std::string& load : {everywhere, somewhere}) {
    for (const double instant : {0.025, 0.0251, 0.0252}) {  // two jumps and a kink
      const auto ends = ends_of(load, "ssp-rk3");
      EXPECT_TRUE(std::any_of(ends.begin(), ends.end(), [instant](const StepEnd& end) {
        return std::abs(end.before - instant) < 1e-9;
      })) << instant;
    }
  }
  EXPECT_EQ(ends_of(everywhere).size(), 5U) << "and what keeps the budget of leapfrog";
  EXPECT_EQ(ends_of(somewhere).size(), 5U);
  // nor a delay of next to nothing: one jump from before the first place to behind the last
  const auto delayed = jumps_of("type = \"pressure\"\nvalue = \"t - 1e-9*x < 0.0251 ? 1 : 0\"\n");
  ASSERT_EQ(delayed.size(), 1U);
  EXPECT_EQ(delayed[0].before, std::nextafter(0.0251, 0));
  EXPECT_NEAR(delayed[0].after - 0.0251, 1e-9, 1e-15);
  // waves that steps see need no ends, wherever they are
  EXPECT_TRUE(ends_of("type = \"pressure\"\nvalue = \"sin(300*(t - x/40))\"\n").empty());
}

}  // namespace
}  // namespace diptych::run
