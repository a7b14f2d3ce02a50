#include "meshes/surface.hpp"

#include "meshes/generators.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::meshes {
namespace {

/// Radii 1 to 2, half a turn, height 1 (no height in the plane); inner nodes and those of the arcs
/// are not where a lattice has them.
Mesh half_ring(CellType type, int n) {
  const bool is_flat = type == CellType::triangle || type == CellType::quadrilateral;
  Mesh mesh = box(type, {1, 0, 0}, {2, 1, is_flat ? 0. : 1.}, {n, 3 * n, is_flat ? 1 : n});
  for (Vec3& X : mesh.nodes) {
    const double r = X[0], z = X[2];
    const double angle = std::numbers::pi * (X[1] + 0.05 * std::sin(2 * std::numbers::pi * X[1]));
    X = Vec3(r * std::cos(angle), r * std::sin(angle), z);
  }
  return mesh;
}

double area_of(const Mesh& mesh, const Surface& surface, const std::string& group) {
  double area = 0;
  for (const std::int32_t f : mesh.group(group).faces) {
    for (const SurfacePoint& point : surface.points(f, 1))
      area += point.area.norm();
  }
  return area;
}

TEST(Surface, HasTheAreasOfArcsToThirdOrder) {
  for (const CellType type : {CellType::triangle, CellType::tetrahedron, CellType::hexahedron}) {
    double of_facets = 0, before = 0;
    for (const int n : {4, 16}) {
      const Mesh mesh = half_ring(type, n);
      const Surface surface(mesh);
      const double error = std::abs(area_of(mesh, surface, "x_max") / (2 * std::numbers::pi) - 1);
      if (n == 16) {
        EXPECT_LE(error, before / 50);
        for (const std::int32_t f : mesh.group("x_max").faces)
          of_facets += surface.facet_area(f).norm() / (2 * std::numbers::pi);
        EXPECT_LE(error, 0.005 * (1 - of_facets));
      }
      before = error;
    }
  }
}

TEST(Surface, LiesOnTheArcAndIsClosed) {
  for (const CellType type : {CellType::triangle, CellType::tetrahedron, CellType::prism}) {
    const Mesh mesh = half_ring(type, 6);
    const Surface surface(mesh);
    double off = 0, off_facets = 0;
    for (const std::int32_t f : mesh.group("x_max").faces) {
      EXPECT_TRUE(surface.is_curved(f));
      for (const SurfacePoint& point : surface.points(f, 1)) {
        off = std::max(off, std::abs(point.X.head<2>().norm() - 2));
        off_facets = std::max(off_facets, std::abs((point.X - point.bulge).head<2>().norm() - 2));
      }
    }
    EXPECT_LE(off, 0.1 * off_facets);
    Vec3 sum = Vec3::Zero();
    for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
      for (const SurfacePoint& point : surface.points(static_cast<std::int32_t>(f), 1))
        sum += point.area;
    }
    EXPECT_LE(sum.norm(), 1e-13);
  }
}

/// The straight sides of the half ring are plane, and their middles stay where they are.
TEST(Surface, BendsNoPlaneSidesAndRoundsNoKinks) {
  const Mesh ring = half_ring(CellType::tetrahedron, 4);
  const Surface surface(ring);
  for (const char* group : {"y_min", "y_max"}) {
    for (const std::int32_t f : ring.group(group).faces)
      EXPECT_FALSE(surface.is_curved(f)) << group;
  }
  for (const CellType type : {CellType::triangle, CellType::tetrahedron, CellType::hexahedron}) {
    Mesh roof = box(type, {0, 0, 0}, {1, 1, type == CellType::triangle ? 0. : 1.},
                    {6, 6, type == CellType::triangle ? 1 : 6});
    for (Vec3& X : roof.nodes)  // sides that meet at 166 degrees
      X[1] += 0.25 * X[1] * std::min(X[0], 1 - X[0]);
    EXPECT_FALSE(Surface(roof).has_curved_faces());
  }
}

}  // namespace
}  // namespace diptych::meshes
