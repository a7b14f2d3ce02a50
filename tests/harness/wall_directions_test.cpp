/// Rigid walls whose normals point away from the body.

#include "benchmarks/run/wall_directions.hpp"

#include "common/base/error.hpp"
#include "meshes/generators.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::HasSubstr;

cases::Case with_wall(const std::vector<std::string>& groups, const algebra::Vec3& normal) {
  cases::Case setup;
  cases::BoundaryCase wall;
  wall.groups = groups;
  wall.type = "rigid-wall";
  wall.normal = normal;
  setup.boundaries = {wall};
  return setup;
}

TEST(WallDirections, AwayFromTheBodyAreRefused) {
  const meshes::Mesh mesh =
      meshes::box(meshes::CellType::quadrilateral, {0, 0, 0}, {1, 1, 0}, {4, 4, 0});
  for (const algebra::Vec3& normal : {algebra::Vec3(1, 0, 0), algebra::Vec3(1, 5, 0)})
    EXPECT_NO_THROW(require_walls_before_sides(with_wall({"x_min"}, normal), mesh));
  // a side along which the wall stands, and one of two that looks at it
  EXPECT_NO_THROW(require_walls_before_sides(with_wall({"y_min"}, {1, 0, 0}), mesh));
  EXPECT_NO_THROW(require_walls_before_sides(with_wall({"x_min", "x_max"}, {1, 0, 0}), mesh));
  try {
    require_walls_before_sides(with_wall({"x_min"}, {-2, 0, 0}), mesh);
    FAIL() << "the body would pass the wall";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no face of x_min looks against the normal (-2, 0, 0)"));
  }
}

}  // namespace
}  // namespace diptych::harness
