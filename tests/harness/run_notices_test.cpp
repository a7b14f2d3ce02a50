/// What a run says of itself at its end: losses, rest, and energies that are rounding.

#include "benchmarks/run/run_case.hpp"
#include "common/cases/reader.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

io::RunSummary summary_of(const std::string& text) {
  RunOptions options;
  options.threads = 1;
  options.quiet = true;
  return run_case(cases::case_from_text(text, "scene"), options).summary;
}

/// Of rubber.
std::string square(const std::string& sections) {
  return R"toml([mesh]
element = "quadrilateral"
cells = [6, 6]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
)toml" + sections;
}

TEST(Notices, TellOfDissipationUnlessALimiterIsOfShocks) {
  const auto notices_with = [&](const std::string& limiter) {
    return summary_of(square("[initial]\nvelocity = [\"sin(3*pi*x)\", 0]\n[time]\nend = 0.012\n"
                             "[scheme]\nlimiter = \"" +
                             limiter + "\"\n"))
        .notices;
  };
  const auto told = Contains(HasSubstr("numerical dissipation took"));
  EXPECT_THAT(notices_with("none"), told);
  EXPECT_THAT(notices_with("sign-preserving"), told);
  EXPECT_THAT(notices_with("venkatakrishnan"), Not(told));
}

TEST(Notices, TellOfLoadsThatMoveNothing) {
  const std::string idle = square(R"toml([[boundary]]
group = "x_max"
type = "traction"
value = ["1e4*(1 + cos(pi*x))", "t > 1 ? 1e4 : 0"]
[time]
end = 0.01
)toml");
  const auto told = Contains(HasSubstr("nothing moves the body"));
  const io::RunSummary whole = summary_of(idle);
  EXPECT_EQ(whole.status, "done");
  EXPECT_THAT(whole.notices, told);
  // what moves it may be to come
  EXPECT_THAT(summary_of(idle + "max_steps = 2\n").notices, Not(told));
}

// H and J are rounded in every step: a strip was stopped at a residual of -1500 after 3372 steps.
TEST(Notices, TellOfEnergiesThatAreRoundingWithoutStoppingBodies) {
  const io::RunSummary summary = summary_of(R"toml(
[mesh]
element = "quadrilateral"
lower = [0, 0]
upper = [1.5, 0.1]
cells = [24, 4]
[material]
density = 1
shear_modulus = 1000
lame = 1500
zeta_ratio = 0.4
[[boundary]]
group = "x_min"
type = "fixed"
[[boundary]]
group = "x_max"
type = "traction"
value = [0, "2e-7*t"]
[time]
end = 0.7
)toml");
  EXPECT_EQ(summary.status, "done");
  EXPECT_THAT(summary.notices, Contains(HasSubstr("strain energy is what rounding leaves of it")));
}

}  // namespace
}  // namespace diptych::harness
