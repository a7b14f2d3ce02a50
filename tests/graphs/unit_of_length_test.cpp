/// Operators are those of the body, whatever the unit of its length: millimetres, a mesh of ten
/// metres a cell. A bound on changes of weights beside shares in another unit took others, or
/// refused the mesh, as soon as cells were longer than a unit or two.

#include "fvm/fvm_graph.hpp"
#include "sph/sph_graph.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace diptych::graphs {
namespace {

std::vector<meshes::Mesh> bodies() {
  std::vector<meshes::Mesh> all;
  for (const CellType type : all_cells) {
    all.push_back(test_box(type, is_flat(type) ? 7 : 4, 0.2));
    all.push_back(bent_box(type, is_flat(type) ? 7 : 4, 0.2));
  }
  meshes::Mesh bar = meshes::box(CellType::hexahedron, {0, 0, 0}, {8, 1, 1}, {16, 2, 2});
  for (Vec3& X : bar.nodes) {
    if (std::abs(X[1] - 0.5) < 0.1) X[1] += 0.03 * std::sin(5 * X[0]);
  }
  all.push_back(bar);
  return all;
}

void expect_scaled(const scheme::PairGraph& of, const scheme::PairGraph& scaled, double scale) {
  ASSERT_EQ(scaled.neighbour, of.neighbour);
  const int d = of.dimension;
  double largest = 0, largest_error = 0;
  for (size_t p = 0; p < of.C.size(); ++p) {
    largest = std::max(largest, of.C[p].norm());
    const Vec3 C = scaled.C[p] / std::pow(scale, d - 1);
    largest_error = std::max(largest_error, (C - of.C[p]).norm());
  }
  EXPECT_LE(largest_error, 3e-3 * largest);  // conditions are met to 1e-4 of an area
  for (size_t a = 0; a < of.Omega.size(); ++a)
    EXPECT_NEAR(scaled.Omega[a] / std::pow(scale, d), of.Omega[a], 1e-9 * of.Omega[a]);
}

TEST(UnitOfLength, ChangesNothing) {
  sph::Options particles;
  particles.gradient = "auto";
  for (const meshes::Mesh& body : bodies()) {
    const scheme::Operators by_sph = sph::operators_on(body, particles);
    const scheme::Operators by_fvm = fvm::operators_on(body, {"auto"});
    for (const double scale : {1e-3, 1e3}) {
      SCOPED_TRACE(std::string(name_of(body.cell_types[0])) + " times " + std::to_string(scale));
      meshes::Mesh scaled = body;
      for (Vec3& X : scaled.nodes)
        X *= scale;
      const scheme::Operators sph_scaled = sph::operators_on(scaled, particles);
      const scheme::Operators fvm_scaled = fvm::operators_on(scaled, {"auto"});
      EXPECT_EQ(sph_scaled.text, by_sph.text);
      EXPECT_EQ(fvm_scaled.text, by_fvm.text);
      expect_scaled(by_sph.graph, sph_scaled.graph, scale);
      expect_scaled(by_fvm.graph, fvm_scaled.graph, scale);
    }
  }
}

}  // namespace
}  // namespace diptych::graphs
