/// Gradients of cells that carry a part of the shear beside volumes of cells (notes 3.11).

#include "common/run/largest_rates.hpp"
#include "common/scheme/volumes/cell_laplacian.hpp"
#include "tests/common/scheme/static_body.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace diptych {
namespace {

using namespace tests;
using enum meshes::CellType;

class ShearOfCellsIn : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(All,
                         ShearOfCellsIn,
                         testing::Values(Kind{hexahedron, 0.25, "sph"},
                                         Kind{hexahedron, 0.25, "fvm", {8, 2, 2}},
                                         Kind{tetrahedron, 0.2, "fvm"},
                                         Kind{prism, 0.2, "fvm", {6, 3, 2}}));

// What cells carry of the shear is taken from the nodes: nothing is changed where the deformation
// is affine, turned bodies included.
TEST_P(ShearOfCellsIn, HasNoPartInAffineMotions) {
  const meshes::Mesh mesh = block(GetParam().type, GetParam().moved, GetParam().cells);
  StaticBody body(mesh, GetParam().method, 0.49, Volumes::cells);
  StaticBody without(mesh, GetParam().method, 0.49, Volumes::cells, 0);
  const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (const Mat3& F : {sheared(), turn, Mat3(turn * sheared())}) {
    const Displacements u = affine(body.graph, F);
    const auto T = body.forces(u), expected = without.forces(u);
    for (size_t a = 0; a < T.size(); ++a)
      EXPECT_LT((T[a] - expected[a]).norm(), 1e-13) << a;
    EXPECT_NEAR(body.energy(u), without.energy(u), 1e-12);
  }
}

// What gradients of cells are there for: waves that the F of nodes sees badly, which a pressure
// that varies from cell to cell pushes.
TEST(ShearOfCells, HoldsTheSoftestMotions) {
  for (const Kind& kind : {Kind{hexahedron, 0.25, "sph"}, Kind{tetrahedron, 0.2, "fvm"}}) {
    const meshes::Mesh mesh = block(kind.type, kind.moved, {3, 3, 3});
    StaticBody with(mesh, kind.method, 0.45, Volumes::cells);
    StaticBody without(mesh, kind.method, 0.45, Volumes::cells, 0);
    EXPECT_GT(least_stiffness(with, 1, Support::none),
              2 * least_stiffness(without, 1, Support::none))
        << kind.method;
  }
}

// What a node gives it takes from others to the last bit: small displacements of a body far from
// the origin push it nowhere. Sums over positions left a force that drove a cylinder out of its
// supports.
TEST(ShearOfCells, KeepsMomentumInSmallDisplacements) {
  const meshes::Mesh mesh = block(hexahedron, 0.25, {4, 4, 4});
  const scheme::PairGraph graph = StaticBody(mesh, "sph", 0.45, Volumes::cells).graph;
  scheme::CellLaplacian::Array X(4 * graph.n_nodes()), x(X.size()), force(X.size());
  std::vector<Vec3> places = graph.X;
  for (Vec3& place : places)
    place += Vec3(100, -70, 30);
  for (size_t a = 0; a < places.size(); ++a) {
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::int64_t>(4 * a + i);
      X[k] = places[a][i];
      x[k] = X[k] + 1e-9 * std::sin(7.0 * static_cast<double>(k));
    }
  }
  const scheme::CellLaplacian laplacian(graph.cells, places, 3, X);
  laplacian.add_forces(x, 1, 0, graph.n_nodes(), force);
  Vec3 sum = Vec3::Zero();
  double largest = 0;
  for (size_t a = 0; a < places.size(); ++a) {
    const Vec3 T(force[4 * a], force[4 * a + 1], force[4 * a + 2]);
    sum += T;
    largest = std::max(largest, T.norm());
  }
  EXPECT_GT(largest, 1e-11);
  EXPECT_LE(sum.norm(), 1e-14 * largest);
}

/// Moved quadrilaterals or triangles, in plane strain.
class PlaneCells : public testing::TestWithParam<Kind> {
 protected:
  StaticBodyIn<2> body_with(double shear) const {
    const Kind& kind = GetParam();
    return {block(kind.type, kind.moved, kind.cells), kind.method, 0.45, Volumes::cells, shear};
  }
  static Mat3 sheared_in_plane() {
    Mat3 F = Mat3::Identity();
    F.topLeftCorner<2, 2>() << 0.8, 0.3, -0.2, 1.1;
    return F;
  }
};
INSTANTIATE_TEST_SUITE_P(All,
                         PlaneCells,
                         testing::Values(Kind{quadrilateral, 0.2, "sph", {5, 4, 1}},
                                         Kind{quadrilateral, 0.2, "fvm", {8, 2, 1}},
                                         Kind{triangle, 0.2, "fvm", {5, 4, 1}}));

TEST_P(PlaneCells, ShearOfCellsHasNoPartInAffineMotions) {
  auto with = body_with(0.5), without = body_with(0);
  const Displacements u = affine(with.graph, sheared_in_plane());
  const auto T = with.forces(u), expected = without.forces(u);
  for (size_t a = 0; a < T.size(); ++a)
    EXPECT_LT((T[a] - expected[a]).norm(), 1e-13) << a;
  EXPECT_NEAR(with.energy(u), without.energy(u), 1e-12);
}

/// Noise in the plane.
Displacements noisy_in_plane(Displacements u, double size) {
  u = noisy(std::move(u), size);
  for (Vec3& x : u)
    x[2] = 0;
  return u;
}

TEST_P(PlaneCells, ForceIsTheDerivativeOfTheEnergy) {
  auto body = body_with(0.5);
  const Displacements u = noisy_in_plane(affine(body.graph, sheared_in_plane()), 0.02);
  const Displacements direction = noisy_in_plane(Displacements(u.size(), Vec3::Zero()), 1);
  expect_derivative_of_energy(body, u, direction);
}

/// Largest eigenvalue of the second variation of the energy at rest over the nodal volumes.
template <int Dim>
double largest_stiffness(StaticBodyIn<Dim>& body) {
  const auto n = Dim * std::ssize(body.graph.X);
  const Displacements rest(body.graph.X.size(), Vec3::Zero());
  Eigen::MatrixXd K(n, n);
  const double step = 1e-6;
  for (Eigen::Index q = 0; q < n; ++q) {
    Displacements plus = rest, minus = rest;
    plus[q / Dim][q % Dim] += step;
    minus[q / Dim][q % Dim] -= step;
    const auto up = body.forces(plus), down = body.forces(minus);
    for (Eigen::Index p = 0; p < n; ++p)
      K(p, q) = -(up[p / Dim][p % Dim] - down[p / Dim][p % Dim]) / (2 * step) /
                std::sqrt(body.graph.Omega[p / Dim] * body.graph.Omega[q / Dim]);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (K + K.transpose()));
  return solver.eigenvalues()[n - 1];
}

/// The largest frequency that the default step takes is that of the forces: Lanczos comes within
/// a percent or two, from below.
template <int Dim>
void expect_frequency_of_forces(StaticBodyIn<Dim> body, double shear) {
  const double pressure = rubber(0.45).lame + 2, expected = std::sqrt(largest_stiffness(body));
  const run::ElasticRatios ratios{std::sqrt(1 / pressure),
                                  body.material->volumetric_modulus() / pressure, shear / pressure};
  run::LargestRates<Dim> largest(body.body, 0);
  const double omega = std::sqrt(pressure) * largest.frequency(ratios);
  EXPECT_LT(omega, expected * (1 + 1e-6));
  EXPECT_GT(omega, expected * 0.97);
}

TEST_P(PlaneCells, GiveTheStepTheFrequencyOfTheirForces) {
  for (const double shear : {0.0, 0.5, 1.0})
    expect_frequency_of_forces(body_with(shear), shear);
}

TEST(ShearOfCells, GivesTheStepTheFrequencyOfItsForces) {
  for (const double shear : {0.0, 0.5, 1.0}) {
    expect_frequency_of_forces(
        StaticBody(block(hexahedron, 0.25, {3, 2, 2}), "fvm", 0.45, Volumes::cells, shear), shear);
    expect_frequency_of_forces(
        StaticBody(block(tetrahedron, 0.2, {2, 2, 2}), "fvm", 0.45, Volumes::cells, shear), shear);
  }
}

// With the lengths in other units: 1 um.
TEST(ShearOfCells, GivesTheSameStepToSmallBodies) {
  const auto frequency = [](double size) {
    const meshes::Mesh mesh =
        meshes::box(tetrahedron, Vec3::Zero(), size * Vec3::Ones(), {2, 2, 2});
    StaticBody body(mesh, "fvm", 0.45, Volumes::cells);
    run::LargestRates<3> largest(body.body, 0);
    return size * largest.frequency({0.3, 0.5, 0.1});
  };
  EXPECT_NEAR(frequency(1e-6) / frequency(1), 1, 1e-6);
}

class LongCells : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(All,
                         LongCells,
                         testing::Values(Kind{hexahedron, 0, "fvm", {4, 2, 2}},
                                         Kind{hexahedron, 0.2, "fvm", {4, 2, 2}},
                                         Kind{hexahedron, 0, "sph", {4, 2, 2}},
                                         Kind{hexahedron, 0, "fvm", {3, 3, 1}},
                                         Kind{hexahedron, 0, "sph", {3, 3, 1}},
                                         Kind{prism, 0, "fvm", {2, 2, 3}},
                                         Kind{tetrahedron, 0.1, "fvm", {3, 2, 2}}));

// However long cells are, what they carry of the shear takes no stiffness from a body at rest, were
// it all of the modulus.
TEST_P(LongCells, AreNoSofterWithShearOfCells) {
  const Kind& kind = GetParam();
  const bool is_sph = kind.method == std::string("sph");  // whose supports go by the volume
  for (const double aspect : {1.0, is_sph ? 1.5 : 4.0, is_sph ? 2.0 : 10.0}) {
    meshes::Mesh mesh = block(kind.type, kind.moved, kind.cells);
    for (Vec3& X : mesh.nodes)
      X[0] *= aspect;
    StaticBody with(mesh, kind.method, 0.45, Volumes::cells, 1);
    StaticBody without(mesh, kind.method, 0.45, Volumes::cells, 0);
    EXPECT_GT(least_stiffness(with, 1, Support::none),
              least_stiffness(without, 1, Support::none) * (1 - 1e-3))
        << aspect;
  }
}

TEST_P(ShearOfCellsIn, IsObjective) {
  StaticBody body(block(GetParam().type, GetParam().moved, GetParam().cells), GetParam().method,
                  0.45, Volumes::cells);
  const Displacements u = noisy(affine(body.graph, sheared()), 0.02);
  const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  Displacements turned;
  for (size_t a = 0; a < u.size(); ++a)
    turned.push_back(turn * (body.graph.X[a] + u[a]) - body.graph.X[a]);
  EXPECT_NEAR(body.energy(turned), body.energy(u), 1e-12);
  const auto T = body.forces(u), expected = body.forces(turned);
  for (size_t a = 0; a < u.size(); ++a)
    EXPECT_LT((turn * T[a] - expected[a]).norm(), 1e-12) << a;
}

}  // namespace
}  // namespace diptych
