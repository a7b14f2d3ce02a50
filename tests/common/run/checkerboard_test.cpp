/// The part of a field that alternates from node to node, on lattices, moved nodes and tetrahedra.

#include "common/run/checkerboard.hpp"

#include "meshes/incidence.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace diptych {
namespace {

using algebra::Vec3;

struct MeshCase {
  const char* element;
  double moved;  ///< by a share of the spacing
};

std::ostream& operator<<(std::ostream& out, const MeshCase& mesh) {
  return out << mesh.element << " moved by " << mesh.moved;
}

/// Of a field on a unit square or cube with n cells along each edge.
double part_of(const MeshCase& of, int n, const std::function<double(const Vec3&)>& field) {
  const bool plane =
      std::string(of.element) == "quadrilateral" || std::string(of.element) == "triangle";
  const std::string cells =
      plane ? fmt::format("[{0}, {0}]", n) : fmt::format("[{0}, {0}, {0}]", n);
  cases::Case setup = cases::case_from_text(
      fmt::format("[mesh]\nelement = \"{}\"\ncells = {}\n{}[material]\nmodel = \"mooney-rivlin\"\n"
                  "density = 1000\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\nzeta_ratio = 0.5\n"
                  "[fvm]\nstencil = \"edge\"\n[time]\nend = 1\n",
                  of.element, cells,
                  of.moved > 0 ? fmt::format("perturbation = {}\n", of.moved) : ""),
      "checkerboard", {});
  const tests::Scene s("fvm", setup);
  const meshes::NodalGraph around = meshes::nodal_graph(s.mesh.mesh);
  const run::Checkerboard checkerboard(s.graph.X, s.graph.Omega, s.graph.dimension,
                                       [&](std::int32_t a, std::vector<std::int32_t>& nodes) {
                                         const auto near = around.around(a);
                                         nodes.insert(nodes.end(), near.begin(), near.end());
                                       });
  std::vector<double> q;
  for (const Vec3& X : s.graph.X)
    q.push_back(field(X));
  return checkerboard.part_of(q, s.graph.Omega);
}

class CheckerboardOn : public testing::TestWithParam<MeshCase> {};

TEST_P(CheckerboardOn, LinearFieldsHaveNone) {
  EXPECT_LT(part_of(GetParam(), 5, [](const Vec3& X) { return 7 + 3 * X[0] - 2 * X[1] + X[2]; }),
            1e-12);
  EXPECT_EQ(part_of(GetParam(), 5, [](const Vec3&) { return 0.1; }), 0);
}

TEST_P(CheckerboardOn, OfSmoothFieldsItFallsWithTheSquareOfTheSpacing) {
  const auto smooth = [](const Vec3& X) { return std::sin(3 * X[0]) * std::cos(2 * X[1] + X[2]); };
  const double coarse = part_of(GetParam(), 6, smooth), fine = part_of(GetParam(), 12, smooth);
  EXPECT_GT(std::log2(coarse / fine), 1.6) << coarse << ", " << fine;
}

INSTANTIATE_TEST_SUITE_P(Meshes,
                         CheckerboardOn,
                         testing::Values(MeshCase{"hexahedron", 0},
                                         MeshCase{"hexahedron", 0.2},
                                         MeshCase{"tetrahedron", 0},
                                         MeshCase{"quadrilateral", 0},
                                         MeshCase{"triangle", 0.2}));

TEST(Checkerboard, OfAFieldThatAlternatesIsAboutOne) {
  const auto along = [](double x) { return std::lround(8 * x) % 2 == 0 ? 1.0 : -1.0; };
  const double all = part_of(
      {"hexahedron", 0}, 8, [&](const Vec3& X) { return along(X[0]) * along(X[1]) * along(X[2]); });
  const double one = part_of({"hexahedron", 0}, 8, [&](const Vec3& X) { return along(X[0]); });
  EXPECT_NEAR(all, 1.070, 0.001);  // nodes at the boundary have fewer neighbours
  EXPECT_NEAR(one, 1.326, 0.001);
  // beside a smooth field: the share that the amplitude has
  const double beside = part_of({"hexahedron", 0}, 8, [&](const Vec3& X) {
    return X[2] + 0.1 * along(X[0]) * along(X[1]) * along(X[2]);
  });
  EXPECT_NEAR(beside, all * 0.1 / std::sqrt(1.0 / 12 + 0.01), 0.05);
}

}  // namespace
}  // namespace diptych
