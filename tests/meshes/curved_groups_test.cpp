#include "meshes/curved_groups.hpp"

#include "meshes/generators.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::meshes {
namespace {

TEST(CurvedGroups, BendAndPlanesWithEdgesBetweenThemDoNot) {
  Mesh mesh = box(CellType::hexahedron, {0, 0, 0}, {1, 1, 1}, {4, 4, 4});
  BoundaryGroup all{"all", {}};
  for (const BoundaryGroup& group : mesh.boundary_groups)
    all.faces.insert(all.faces.end(), group.faces.begin(), group.faces.end());
  EXPECT_LT(largest_bend(mesh, all), 1e-6);
  for (Vec3& X : mesh.nodes) {  // z_min and z_max: arcs of radius 1/k
    constexpr double k = 0.4;
    X = Vec3(std::sin(k * X.x()) * (1 / k + X.z()), X.y(), std::cos(k * X.x()) * (1 / k + X.z()));
  }
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    const bool is_arc = group.name.front() == 'z';
    EXPECT_NEAR(largest_bend(mesh, group), is_arc ? 0.1 * 180 / M_PI : 0, 1e-5) << group.name;
  }
}

}  // namespace
}  // namespace diptych::meshes
