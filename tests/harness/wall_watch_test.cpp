/// A body that passes through a wall which its sides may not touch is told of; bodies that stop at
/// a wall are not.

#include "benchmarks/run/run_case.hpp"
#include "common/cases/reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

/// A square that flies 0.3 m through the plane x = -0.02 unless that group stops it.
std::vector<std::string> notices_of(const std::string& groups, const std::string& method) {
  const cases::Case setup = cases::case_from_text(fmt::format(R"toml(
[mesh]
element = "quadrilateral"
upper = [1, 1]
cells = [8, 8]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[initial]
velocity = [-3, 0]
[[boundary]]
group = {}
type = "rigid-wall"
point = [-0.02, 0]
normal = [1, 0]
[time]
end = 0.1
)toml",
                                                              groups),
                                                  "scene", {});
  RunOptions options;
  options.method = method;
  options.quiet = true;
  return run_case(setup, options).summary.notices;
}

TEST(WallWatch, TellsOfSidesThatGoThroughAWall) {
  const auto notices = notices_of(R"(["y_min", "y_max"])", "fvm");
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_THAT(notices[0], testing::HasSubstr("went through a rigid wall"));
  EXPECT_THAT(notices[0], testing::HasSubstr("only the groups y_min, y_max may touch it"));
}

TEST(WallWatch, SaysNothingOfABodyThatStopsThere) {
  for (const char* method : {"sph", "fvm"})
    EXPECT_THAT(notices_of(R"(["x_min"])", method),
                testing::Each(testing::Not(testing::HasSubstr("went through"))))
        << method;
}

}  // namespace
}  // namespace diptych::harness
