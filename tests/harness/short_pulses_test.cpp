/// What acts for a small part of a run only, at none of the instants that a run begins with.

#include "benchmarks/run/run_case.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::HasSubstr;

cases::Case square(const std::string& boundary) {
  return cases::case_from_text(R"([mesh]
element = "quadrilateral"
cells = [8, 8]
[material]
model = "neo-hookean"
density = 1
shear_modulus = 1
lame = 1.5
[time]
end = 1
[output]
fields = false
)" + boundary,
                               "square");
}

RunResult run(const cases::Case& setup, const std::string& method) {
  RunOptions options;
  options.method = method;
  options.threads = 1;
  options.quiet = true;
  return run_case(setup, options);
}

// 0.16 m x 0.05 Pa x 0.1 s; 6.25e-4 were given, as nodes see the strip.
TEST(ShortPulses, OfLoadsOnPartOfASideHaveTheirImpulse) {
  const cases::Case setup = square(R"toml([[boundary]]
group = "y_max"
type = "pressure"
value = "(x > 0.42 && x < 0.58 ? 1 : 0)*0.05*max(0, 1 - abs(t - 0.5)/0.1)"
[[boundary]]
group = "y_min"
type = "traction"
value = ["0.02*t", 0]
)toml");
  for (const char* method : {"sph", "fvm"}) {
    const RunResult result = run(setup, method);
    EXPECT_NEAR(result.history.back().linear_momentum[1], -8e-4, 8e-6) << method;
  }
}

TEST(ShortPulses, OfSupportsThatOthersHoldAreRefused) {
  const cases::Case setup = square(R"toml([[boundary]]
group = "x_min"
type = "velocity"
value = [0, "0.1*max(0, 1 - abs(t - 0.55)/0.1)"]
[[boundary]]
group = "y_min"
type = "fixed"
)toml");
  try {
    (void)run(setup, "fvm");
    FAIL() << "the corner is held and moved";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("share the node at (0, 0, 0)"));
  }
}

}  // namespace
}  // namespace diptych::harness
