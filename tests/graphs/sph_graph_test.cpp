#include "sph/sph_graph.hpp"

#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "fvm/fvm_graph.hpp"
#include "sph/kernel_correction.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych::graphs {
namespace {

TEST(SphGraph, SharesNodesVolumesAndAreasWithFvm) {
  for (CellType type : all_cells) {
    const meshes::Mesh mesh = test_box(type, 4, 0.2);
    const scheme::PairGraph particles = sph::build_graph(mesh, {}),
                            cells = fvm::build_graph(mesh, {});
    EXPECT_EQ(particles.X, cells.X);
    EXPECT_EQ(particles.Omega, cells.Omega);
    EXPECT_EQ(particles.boundary_area, cells.boundary_area);
    ASSERT_EQ(particles.patches.size(), cells.patches.size());
    for (size_t i = 0; i < cells.patches.size(); ++i) {
      EXPECT_EQ(particles.patches[i].area, cells.patches[i].area);
    }
  }
}

TEST(SphGraph, HasTheNeighboursOfTheLattice) {
  const auto inner_neighbours = [](double kappa) {
    sph::Options options;
    options.kappa = kappa;
    const auto graph = sph::build_graph(
        meshes::box(CellType::hexahedron, {0, 0, 0}, {8, 8, 8}, {8, 8, 8}), options);
    const int centre = 4 + 9 * (4 + 9 * 4);
    return graph.row[centre + 1] - graph.row[centre];
  };
  EXPECT_EQ(inner_neighbours(1.2), 56);  // notes 2.1
  EXPECT_EQ(inner_neighbours(1.5), 92);
  EXPECT_EQ(inner_neighbours(1.01), 32);  // support just above two spacings
}

/// Without the repair the layers at the boundary carry the wrong areas (notes 3.3, O(1)).
TEST(SphGraph, IsNotClosedWithoutTheRepair) {
  sph::Options options;
  options.closure = false;
  const auto graph = sph::build_graph(test_box(CellType::quadrilateral, 8, 0), options);
  EXPECT_GT(scheme::quality(graph).closure, 0.1);
  EXPECT_LT(scheme::quality(graph).linear_exactness, 1e-13);
}

/// 20 % disorder and the repair together cost less than 5 % of the bare kernel's stable step.
TEST(SphGraph, KeepsItsStableStepUnderTheRepair) {
  for (double fraction : {0.0, 0.2}) {
    meshes::Mesh mesh = meshes::box(CellType::hexahedron, {0, 0, 0}, {8, 8, 8}, {8, 8, 8});
    meshes::perturb_interior(mesh, fraction, 5);
    sph::Options bare;
    bare.closure = false;
    EXPECT_GT(graph_bound(sph::build_graph(mesh, {})),
              0.95 * graph_bound(sph::build_graph(mesh, bare)));
  }
}

std::string refusal(const meshes::Mesh& mesh, const sph::Options& options) {
  try {
    sph::build_graph(mesh, options);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SphGraph, NamesAParticleWithTooFewNeighbours) {
  sph::Options narrow;
  narrow.kappa = 0.55;  // support 1.1 spacings: three neighbours at a corner
  EXPECT_THAT(refusal(test_box(CellType::hexahedron, 3, 0), narrow),
              testing::AllOf(testing::HasSubstr("particle 0 at (-0.5, 0.1, 0)"),
                             testing::HasSubstr("neighbours")));
  narrow.kappa = 1.5;  // one sheet of particles, further from the others than its support
  meshes::Mesh slab = meshes::box(CellType::hexahedron, {0, 0, 0}, {6, 6, 81}, {6, 6, 81});
  for (algebra::Vec3& X :
       slab.nodes)  // the other cells are so thin that they are cubes in the mean
    X[2] = X[2] == 0 ? -9 : X[2] / 9;
  EXPECT_THAT(refusal(slab, narrow), testing::HasSubstr("plane"));
}

TEST(SphGraph, RefusesBadOptions) {
  const meshes::Mesh mesh = test_box(CellType::triangle, 4, 0);
  sph::Options options;
  options.kappa = std::nan("");
  EXPECT_THAT(refusal(mesh, options), testing::HasSubstr("kappa"));
  options = {};
  options.kernel = "quintic";
  EXPECT_THAT(refusal(mesh, options), testing::HasSubstr("unknown kernel"));
}

/// More particles than the least number for which the closure uses threads.
TEST(SphGraph, HasTheSameBitsForEveryNumberOfThreads) {
  const meshes::Mesh mesh = test_box(CellType::hexahedron, 21, 0.2);
  std::vector<scheme::PairGraph> graphs;
  for (const int n : {1, 2, 5}) {
    parallel::set_threads(n);
    graphs.push_back(sph::build_graph(mesh, {}));
  }
  parallel::set_threads(0);
  for (const scheme::PairGraph& graph : graphs) {
    EXPECT_EQ(graph.neighbour, graphs[0].neighbour);
    EXPECT_EQ(graph.C, graphs[0].C);
  }
  EXPECT_LT(scheme::quality(graphs[0]).closure, 1e-12);
}

}  // namespace
}  // namespace diptych::graphs
