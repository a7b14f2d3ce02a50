/// Bodies of few cells across sum by parts where a few of their nodes stand badly: rows there reach
/// further, and weights keep their proportion.

#include "common/base/error.hpp"
#include "common/closure/summation_by_parts.hpp"
#include "fvm/fvm_graph.hpp"
#include "meshes/quadratic_measure.hpp"
#include "sph/sph_graph.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace diptych::graphs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Two cells across, those at one end 2.2 times as long as those at the other.
meshes::Mesh graded_bar() {
  meshes::Mesh mesh = meshes::box(CellType::hexahedron, {0, 0, 0}, {8, 1, 1}, {12, 2, 2});
  for (Vec3& X : mesh.nodes)
    X[0] = 8 * (std::pow(2.2, X[0] / 8) - 1) / 1.2;
  return mesh;
}

/// The largest error of derivatives of quadratics, in units of the spacing.
double error_of_rows(const scheme::PairGraph& graph) {
  double largest = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        Vec3 sum = Vec3::Zero();
        for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
          const Vec3 X = graph.X[graph.neighbour[p]] - graph.X[a];
          sum += 0.5 * X[i] * X[j] * graph.C[p];
        }
        largest = std::max(largest, sum.norm() / graph.Omega[a]);
      }
    }
  }
  return largest;
}

/// A corner at the coarse end has sixteen neighbours that stand in few planes. The whole body took
/// the corrected gradient for it, and bent 2.4 times as far as it should.
TEST(FewNeighbours, AreMoreWhereTheyDetermineNoQuadratic) {
  const meshes::Mesh mesh = graded_bar();
  sph::Options options;
  options.closure = false;
  options.gradient = "corrected";
  scheme::PairGraph narrow = sph::build_graph(mesh, options);
  const std::vector<double> ones(narrow.C.size(), 1.0);
  try {
    closure::make_sum_by_parts(narrow, ones);
    ADD_FAILURE() << "was taken";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("do not determine a quadratic"));
  }
  options = {};
  options.gradient = "auto";
  const scheme::Operators taken = sph::operators_on(mesh, options);
  EXPECT_THAT(taken.text, StartsWith("sbp"));
  EXPECT_LE(error_of_rows(taken.graph), 1e-4);
  EXPECT_LE(scheme::quality(taken.graph).closure, 1e-10);
}

/// No lines to derive along: the edge stencil, which stood in, bends 19 to 36 % too little.
TEST(FewNeighbours, AreThoseOfCellsWhereLinesAreShort) {
  meshes::Mesh mesh = graded_bar();
  for (Vec3& X : mesh.nodes)
    X.tail<2>() *= 1 - 0.04 * X[0];
  const scheme::Operators taken = fvm::operators_on(mesh, {"auto"});
  EXPECT_THAT(taken.text, StartsWith("sbp: order 2 on the cells"));
  EXPECT_LE(error_of_rows(taken.graph), 1e-4);
}

/// 16 x 2 x 2 cells of half a unit along the bar, whose middle line waves by so much.
meshes::Mesh waved_bar(double by) {
  meshes::Mesh mesh = meshes::box(CellType::hexahedron, {0, 0, 0}, {8, 1, 1}, {16, 2, 2});
  for (Vec3& X : mesh.nodes) {
    if (std::abs(X[1] - 0.5) < 0.1) X[1] += by * std::sin(5 * X[0]);
  }
  return mesh;
}

/// Sides whose nodes stand nearly in three lines tell cubics from quadratics by next to nothing.
TEST(FewNeighbours, KeepTheirShareOfSidesInNearlyThreeLines) {
  const meshes::Mesh mesh = waved_bar(5e-3);
  const meshes::DualMeasure measure = meshes::quadratic_measure(mesh);
  const meshes::DualMeasure share = meshes::dual_measure(mesh, meshes::Quadrature::exact);
  for (size_t a = 0; a < mesh.nodes.size(); ++a) {
    EXPECT_LE(measure.boundary_area[a].norm(), 2.5 * share.boundary_area[a].norm()) << a;
    EXPECT_GT(measure.Omega[a], 0.2 * share.Omega[a]) << a;
  }
}

/// No areas of such sides meet all conditions, but those of linear fields, without which forces of
/// a constant stress are not in balance. Where the line waves by a tenth of a cell or more both
/// methods took operators of second order, and SPH bent three times as far as it should.
TEST(FewNeighbours, CloseOnUnevenSides) {
  for (const double by : {5e-3, 0.05, 0.1}) {
    const meshes::Mesh mesh = waved_bar(by);
    sph::Options options;
    options.gradient = "auto";
    for (const scheme::Operators& taken :
         {sph::operators_on(mesh, options), fvm::operators_on(mesh, {"auto"})}) {
      EXPECT_THAT(taken.text, StartsWith("sbp")) << by;
      EXPECT_LE(error_of_rows(taken.graph), 0.03) << by;  // closing them costs quadratics some
      EXPECT_LE(scheme::quality(taken.graph).closure, 1e-12) << by;
    }
  }
}

}  // namespace
}  // namespace diptych::graphs
