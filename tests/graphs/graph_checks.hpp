#pragma once
/// Meshes and fields that the tests of the graphs share.

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/generators.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace diptych::graphs {

using algebra::Mat3;
using algebra::Vec3;
using meshes::CellType;

inline const std::vector<CellType> all_cells = {CellType::triangle, CellType::quadrilateral,
                                                CellType::tetrahedron, CellType::hexahedron,
                                                CellType::prism};

inline bool is_flat(CellType type) {
  return type == CellType::triangle || type == CellType::quadrilateral;
}

inline std::string name_of(CellType type) {
  static const std::map<CellType, std::string> names = {{CellType::triangle, "triangle"},
                                                        {CellType::quadrilateral, "quadrilateral"},
                                                        {CellType::tetrahedron, "tetrahedron"},
                                                        {CellType::hexahedron, "hexahedron"},
                                                        {CellType::prism, "prism"}};
  return names.at(type);
}

/// A box of 1 x 1.2 (x 0.8), n blocks per direction, interior nodes moved by `fraction`.
inline meshes::Mesh test_box(CellType type, int n, double fraction) {
  meshes::Mesh mesh = meshes::box(type, {-0.5, 0.1, 0}, {0.5, 1.3, is_flat(type) ? 0 : 0.8},
                                  {n, n, is_flat(type) ? 1 : n});
  if (fraction > 0) meshes::perturb_interior(mesh, fraction, 11);
  return mesh;
}

/// test_box bent to 0.8 radians of a ring with the radii 1 and 2.2.
inline meshes::Mesh bent_box(CellType type, int n, double fraction) {
  meshes::Mesh mesh = test_box(type, n, fraction);
  for (Vec3& X : mesh.nodes) {
    const double r = X[1] + 0.9, angle = 0.8 * (0.5 - X[0]);
    X = Vec3(r * std::cos(angle), r * std::sin(angle), X[2]);
  }
  return mesh;
}

/// Random vectors, one per node; without z in 2-D.
inline std::vector<Vec3> random_field(const scheme::PairGraph& graph, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3> v(graph.X.size(), Vec3::Zero());
  for (Vec3& value : v) {
    for (int i = 0; i < graph.dimension; ++i)
      value[i] = normal(engine);
  }
  return v;
}

/// (18b): F_a or its rate = 1/Omega_a sum_b 1/2 (v_b - v_a) (x) C_ab.
inline Mat3 gradient(const scheme::PairGraph& graph, const std::vector<Vec3>& v, std::int64_t a) {
  Mat3 sum = Mat3::Zero();
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
    sum += 0.5 * (v[graph.neighbour[p]] - v[a]) * graph.C[p].transpose();
  }
  return sum / graph.Omega[a];
}

/// (18a) without tractions and dissipation: T_a = sum_b 1/2 (P_a C_ab - P_b C_ba).
inline Vec3 force(const scheme::PairGraph& graph, const std::vector<Mat3>& P, std::int64_t a) {
  Vec3 sum = Vec3::Zero();
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
    sum += 0.5 * (P[a] * graph.C[p] - P[graph.neighbour[p]] * graph.C[graph.reverse(p)]);
  }
  return sum;
}

/// min_a Omega_a / (1/2 sum_b |C_ab|), the length in the graph's CFL bound (notes 2.1).
inline double graph_bound(const scheme::PairGraph& graph) {
  double least = HUGE_VAL;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    double sum = 0;
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
      sum += graph.C[p].norm();
    least = std::min(least, graph.Omega[a] / (0.5 * sum));
  }
  return least;
}

}  // namespace diptych::graphs
