/// Bodies that slide far along curved sides of type "symmetry" are told of; others are not.

#include "benchmarks/run/run_case.hpp"
#include "common/cases/reader.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

/// A sector of 60 degrees of a ring of radii 1 and 2 m, or, of curvature 0, a square:
/// quadrilaterals with the group "rim" on the far side.
std::string mesh_file(double curvature) {
  constexpr int n = 6;
  std::string nodes, cells;
  const auto number = [](int i, int j) { return 1 + i + (n + 1) * j; };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double r = 1 + static_cast<double>(i) / n, along = (static_cast<double>(j) / n - 0.5);
      const double angle = curvature * along * std::acos(-1) / 3;
      const double x = curvature > 0 ? r * std::cos(angle) : r;
      const double y = curvature > 0 ? r * std::sin(angle) : along;
      nodes += fmt::format("{} {} {} 0\n", number(i, j), x, y);
    }
  }
  int n_cells = 0;
  for (int j = 0; j < n; ++j)
    cells += fmt::format("{} 1 2 1 1 {} {}\n", ++n_cells, number(n, j), number(n, j + 1));
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i)
      cells += fmt::format("{} 3 2 2 2 {} {} {} {}\n", ++n_cells, number(i, j), number(i + 1, j),
                           number(i + 1, j + 1), number(i, j + 1));
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"rim\"\n2 2 "
      "\"body\"\n$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      (n + 1) * (n + 1), nodes, n_cells, cells);
}

/// It turns about the origin at 1 rad/s, which slides the rim along itself at 2 m/s.
std::vector<std::string> notices_of(double curvature, double end) {
  const auto folder =
      std::filesystem::temp_directory_path() / fmt::format("diptych-sliding-{}-{}", curvature, end);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "body.msh") << mesh_file(curvature);
  const cases::Case setup = cases::case_from_text(
      fmt::format(R"toml(
[mesh]
file = "{}"
element = "quadrilateral"
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[initial]
velocity = {}
[[boundary]]
group = "rim"
type = "symmetry"
[time]
end = {}
)toml",
                  (folder / "body.msh").string(), curvature > 0 ? R"(["-y", "x"])" : "[0, 2]", end),
      "scene", {});
  RunOptions options;
  options.method = "fvm";
  options.quiet = true;
  std::vector<std::string> slides;
  for (const std::string& notice : run_case(setup, options).summary.notices)
    if (notice.find("slid along a curved side") != notice.npos) slides.push_back(notice);
  std::filesystem::remove_all(folder);
  return slides;
}

TEST(SlidingWatch, TellsOfNodesThatSlideAlongACurve) {
  // s = 0.04 m on R = 2 m: the normal turns by 0.02, s^2/2R = 0.0004 m
  const auto notices = notices_of(1, 0.02);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_THAT(notices[0],
              testing::HasSubstr("curved side (group rim, type symmetry) by up to 0.0"));
  EXPECT_THAT(notices[0], testing::ContainsRegex("turned by 0\\.0(19|2|21)[^0-9]"));
  EXPECT_THAT(notices[0], testing::ContainsRegex("by some 0\\.000(38|39|4|41|42)[^0-9]"));
}

TEST(SlidingWatch, SaysNothingOfSmallSlidesAndOfPlanes) {
  EXPECT_THAT(notices_of(1, 0.004), testing::IsEmpty());
  EXPECT_THAT(notices_of(0, 0.3), testing::IsEmpty());
}

}  // namespace
}  // namespace diptych::harness
