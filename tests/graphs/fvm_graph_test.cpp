#include "fvm/fvm_graph.hpp"

#include "common/base/error.hpp"
#include "meshes/dual_measure.hpp"
#include "meshes/shape_integrals.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <gtest/gtest.h>

namespace diptych::graphs {
namespace {

using PairArea = std::map<std::pair<int, int>, Vec3>;

/// The classical median dual: in each simplex the face of pair ab is made of triangles (3-D: edge
/// midpoint, centroid, centroid of a face at the edge) or is a segment (2-D: edge midpoint,
/// centroid), oriented from a to b.
PairArea median_dual(const meshes::Mesh& mesh) {
  PairArea area;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto nodes = mesh.cell(c);
    const int n = static_cast<int>(nodes.size());
    const auto X = [&](int i) -> Vec3 { return mesh.nodes[nodes[i]]; };
    Vec3 centroid = Vec3::Zero();
    for (int i = 0; i < n; ++i)
      centroid += X(i) / n;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        if (i == j) continue;
        const Vec3 middle = 0.5 * (X(i) + X(j));
        Vec3 face = Vec3::Zero();
        if (n == 3) {
          face = (centroid - middle).cross(Vec3::UnitZ());
          if (face.dot(X(j) - X(i)) < 0) face = -face;
        } else {
          for (int k = 0; k < n; ++k) {
            if (k == i || k == j) continue;
            Vec3 triangle = 0.5 * (centroid - middle).cross((X(i) + X(j) + X(k)) / 3 - middle);
            if (triangle.dot(X(j) - X(i)) < 0) triangle = -triangle;
            face += triangle;
          }
        }
        auto [place, is_new] = area.try_emplace({nodes[i], nodes[j]}, Vec3::Zero());
        place->second += face;
      }
    }
  }
  return area;
}

/// oint N_a N_b N dA: A_f N_f / 12 on triangles, l N / 6 on edges.
PairArea boundary_products(const meshes::Mesh& mesh) {
  PairArea area;
  for (const auto& face : mesh.boundary_faces) {
    const auto shares = face_area_shares(face, mesh.nodes, meshes::Quadrature::exact);
    const Vec3 whole = face.n_nodes * shares[0];
    for (int i = 0; i < face.n_nodes; ++i) {
      for (int j = 0; j < face.n_nodes; ++j) {
        if (i == j) continue;
        auto [place, is_new] = area.try_emplace({face.nodes[i], face.nodes[j]}, Vec3::Zero());
        place->second += whole / (face.n_nodes == 3 ? 12 : 6);
      }
    }
  }
  return area;
}

TEST(FvmOnSimplices, HasTheMedianDualAsItsSkewPartAndBoundaryProductsAsTheRest) {
  for (CellType type : {CellType::triangle, CellType::tetrahedron}) {
    const meshes::Mesh mesh = test_box(type, 4, 0.2);
    const scheme::PairGraph graph = fvm::build_graph(mesh, {"integral"});
    const PairArea dual = median_dual(mesh), products = boundary_products(mesh);
    ASSERT_EQ(dual.size(), static_cast<size_t>(graph.n_pairs()));
    for (int a = 0; a < graph.n_nodes(); ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const std::pair pair{a, graph.neighbour[p]};
        const Vec3 skew = 0.5 * (graph.C[p] - graph.C[graph.reverse(p)]);
        Vec3 rest = 0.5 * (graph.C[p] + graph.C[graph.reverse(p)]);
        if (products.contains(pair)) rest -= products.at(pair);
        EXPECT_NEAR((skew - dual.at(pair)).norm(), 0, 1e-15) << name_of(type);
        EXPECT_NEAR(rest.norm(), 0, 1e-15) << name_of(type);
      }
    }
  }
}

/// Green-Gauss gradient with boundary weights 6/8, 1/8, 1/8 per third of a triangle (5/6, 1/6 per
/// half edge).
TEST(FvmOnSimplices, IsTheGreenGaussGradientOnRandomFields) {
  for (CellType type : {CellType::triangle, CellType::tetrahedron}) {
    const meshes::Mesh mesh = test_box(type, 4, 0.2);
    const scheme::PairGraph graph = fvm::build_graph(mesh, {"integral"});
    const std::vector<Vec3> v = random_field(graph, 9);
    std::vector<Mat3> oracle(mesh.nodes.size(), Mat3::Zero());
    for (const auto& [pair, S] : median_dual(mesh)) {
      oracle[pair.first] += 0.5 * (v[pair.first] + v[pair.second]) * S.transpose();
    }
    for (const auto& face : mesh.boundary_faces) {
      const auto shares = face_area_shares(face, mesh.nodes, meshes::Quadrature::exact);
      const double own = face.n_nodes == 3 ? 6. / 8 : 5. / 6;
      const double other = face.n_nodes == 3 ? 1. / 8 : 1. / 6;
      for (int i = 0; i < face.n_nodes; ++i) {
        for (int j = 0; j < face.n_nodes; ++j) {
          oracle[face.nodes[i]] +=
              (i == j ? own : other) * v[face.nodes[j]] * shares[i].transpose();
        }
      }
    }
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      const Mat3 G = gradient(graph, v, a);
      EXPECT_LE((G - oracle[a] / graph.Omega[a]).norm(), 1e-13 * (1 + G.norm()));
    }
  }
}

TEST(FvmEdgeStencil, HasSixNeighboursAndTheFaceAreasOnALattice) {
  const scheme::PairGraph graph = fvm::build_graph(
      meshes::box(CellType::hexahedron, {0, 0, 0}, {3, 3, 3}, {3, 3, 3}), {"edge"});
  const int a = 1 + 4 * (1 + 4);
  ASSERT_EQ(graph.row[a + 1] - graph.row[a], 6);
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
    EXPECT_NEAR((graph.C[p] - (graph.X[graph.neighbour[p]] - graph.X[a])).norm(), 0, 1e-14);
  }
  EXPECT_NEAR(graph_bound(graph), 1. / 3, 1e-12);
}

TEST(FvmStencils, AreTheSameOnSimplices) {
  const meshes::Mesh mesh = test_box(CellType::tetrahedron, 3, 0.2);
  const scheme::PairGraph edge = fvm::build_graph(mesh, {"edge"});
  const scheme::PairGraph integral = fvm::build_graph(mesh, {"integral"});
  ASSERT_EQ(edge.neighbour, integral.neighbour);
  for (size_t p = 0; p < edge.C.size(); ++p) {
    EXPECT_NEAR((edge.C[p] - integral.C[p]).norm(), 0, 1e-16);
  }
}

/// Interior nodes moved by 20 %: the repaired edge stencil keeps 80 % of the lattice's stable step.
TEST(FvmEdgeStencil, KeepsItsStableStepUnderTheRepair) {
  const meshes::Mesh mesh = [] {
    meshes::Mesh box = meshes::box(CellType::hexahedron, {0, 0, 0}, {8, 8, 8}, {8, 8, 8});
    meshes::perturb_interior(box, 0.2, 5);
    return box;
  }();
  EXPECT_GT(graph_bound(fvm::build_graph(mesh, {"edge"})), 0.8 / 3);
}

/// Curved hexahedra on which no change of six-neighbour rows can close the graph: the vertex
/// measure leaves a gap of second order, which quality() tells, and the rows stay exact for linear
/// fields.
TEST(FvmEdgeStencil, LeavesAGapOfSecondOrderOnATorus) {
  double closure[2];
  for (int level : {0, 1}) {
    const int n = 6 << level;
    meshes::Mesh mesh = meshes::box(CellType::hexahedron, {0, 0, 0}, {1, 1, 1}, {2 * n, n, n});
    for (Vec3& X : mesh.nodes) {
      const double angle = 4.5 * X[0], R = 3 + (X[1] - 0.5) * (1 + 0.3 * X[2]);
      X = Vec3(-R * std::cos(angle), R * std::sin(angle), X[2] * (1 + 0.2 * X[1]));
    }
    const scheme::GraphQuality quality = scheme::quality(fvm::build_graph(mesh, {"edge"}));
    EXPECT_LT(quality.linear_exactness, 1e-12);
    closure[level] = quality.closure;
  }
  EXPECT_LT(closure[0], 1e-2);
  EXPECT_LT(closure[1], 0.3 * closure[0]);
}

TEST(FvmOptions, RefuseAnUnknownStencil) {
  EXPECT_THROW(fvm::build_graph(test_box(CellType::triangle, 2, 0), {"edges"}), base::InputError);
}

}  // namespace
}  // namespace diptych::graphs
