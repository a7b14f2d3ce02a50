#include "common/scheme/boundary/patch_faces.hpp"

#include "common/scheme/boundary/boundary_condition.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::scheme {
namespace {

/// A patch of edges of length one in the plane, each of which turns by so many degrees from the one
/// before. @param factor  of A_aN_a over the sum of the shares of the edges
PairGraph polyline(const std::vector<double>& turns, double factor = 1) {
  PairGraph graph;
  graph.dimension = 2;
  graph.X = {Vec3::Zero(), Vec3::UnitX()};
  BoundaryPatch patch{"line", {0, 1}, {}};
  double angle = 0;
  for (const double turn : turns) {
    angle += turn * std::numbers::pi / 180;
    patch.nodes.push_back(static_cast<std::int32_t>(graph.X.size()));
    graph.X.push_back(graph.X.back() + Vec3(std::cos(angle), std::sin(angle), 0));
  }
  patch.area.assign(graph.X.size(), Vec3::Zero());
  for (std::int32_t a = 0; a + 1 < std::ssize(graph.X); ++a) {
    const Vec3 t = graph.X[a + 1] - graph.X[a];
    patch.faces.push_back({a, a + 1, -1, -1});
    for (const std::int32_t b : {a, a + 1})
      patch.area[b] += factor * 0.5 * Vec3(t[1], -t[0], 0);
  }
  graph.patches.push_back(patch);
  return graph;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values)
    sum += value;
  return sum;
}

std::vector<double> areas_of(const PairGraph& graph) {
  return areas_as_numbers(graph, graph.patches[0]);
}

TEST(AreasAsNumbers, AreThoseOfTheFacesAtKinks) {
  for (const double turn : {1.0, 20.0, 90.0, 150.0, 180.0}) {
    EXPECT_NEAR(sum_of(areas_of(polyline({0, turn, 0}))), 4, 1e-12) << turn;
    // areas of another rule than that of facets: its share, beside a kink of its size
    const std::vector<double> areas = areas_of(polyline({0, turn, 0}, 1.25));
    EXPECT_NEAR(areas[2], turn == 180 ? 1 : 1.25, 1e-9) << turn;
  }
}

TEST(AreasAsNumbers, AreTheVectorsToTheLastBitOnPlanesAndSmoothSides) {
  for (const PairGraph& graph : {polyline({0, 0, 0}), polyline({10, 11, 10, 9}, 1.1)}) {
    const std::vector<double> areas = areas_of(graph);
    for (size_t k = 0; k < areas.size(); ++k)
      EXPECT_EQ(areas[k], graph.patches[0].area[k].norm());
  }
}

TEST(NormalsOfPlanes, AreOneBelowSixtyDegreesAndThoseOfBothSidesAbove) {
  for (const double turn : {0.0, 45.0, 60.0, 70.0, 120.0}) {
    const PairGraph graph = polyline({0, turn, 0});
    const auto normals = normals_of_planes(graph, graph.patches[0]);
    ASSERT_EQ(normals[2].size(), turn < 60 ? 1u : 2u) << turn;
    const double angle = turn * std::numbers::pi / 180;
    if (turn < 60) {
      EXPECT_EQ(normals[2][0], unit_normal(graph.patches[0].area[2]));
    } else {
      for (const Vec3& n : {Vec3(0, -1, 0), Vec3(std::sin(angle), -std::cos(angle), 0)})
        EXPECT_TRUE(std::any_of(normals[2].begin(), normals[2].end(), [&](const Vec3& m) {
          return (m - n).norm() < 1e-12;
        })) << turn;
    }
    EXPECT_EQ(normals[1].size(), 1u);
  }
}

using Meshed = std::tuple<std::string, meshes::CellType>;
class GroupOfAllSides : public testing::TestWithParam<Meshed> {};
INSTANTIATE_TEST_SUITE_P(Both,
                         GroupOfAllSides,
                         testing::Combine(testing::Values("sph", "fvm"),
                                          testing::Values(meshes::CellType::hexahedron,
                                                          meshes::CellType::tetrahedron)));

TEST_P(GroupOfAllSides, HasTheAreasAndTheNormalsOfSixGroups) {
  const auto& [method, type] = GetParam();
  meshes::Mesh mesh = meshes::box(type, {0, 0, 0}, {1, 2, 0.5}, {5, 8, 4});
  meshes::BoundaryGroup all{"all", {}};
  for (size_t f = 0; f < mesh.boundary_faces.size(); ++f)
    all.faces.push_back(static_cast<std::int32_t>(f));
  mesh.boundary_groups.push_back(all);
  for (const cases::Case& setup : {cases::Case(), tests::second_order()}) {
    const PairGraph graph = tests::graph_of(method, mesh, setup);
    EXPECT_NEAR(sum_of(areas_as_numbers(graph, graph.patches.back())), 7, 1e-9);
    const auto normals = normals_of_planes(graph, graph.patches.back());
    for (size_t a = 0; a < normals.size(); ++a) {
      const auto n_sides = std::count_if(
          graph.patches.begin(), graph.patches.end() - 1, [&](const BoundaryPatch& side) {
            return std::binary_search(side.nodes.begin(), side.nodes.end(),
                                      graph.patches.back().nodes[a]);
          });
      EXPECT_EQ(std::ssize(normals[a]), n_sides);
      for (const Vec3& n : normals[a])
        EXPECT_EQ(n.cwiseAbs().maxCoeff(), 1);
    }
  }
}

}  // namespace
}  // namespace diptych::scheme
