/// Volumes that carry the pressure, of deformed cells and by derivatives along lines (notes 3.9,
/// 3.10), and gradients of cells that carry a part of the shear (notes 3.11): what they are, what
/// their forces keep, and that a uniformly compressed body is a strict minimum of its energy.

#include "common/algebra/face_areas.hpp"
#include "common/run/model_menu.hpp"
#include "common/scheme/budget/balance.hpp"
#include "common/scheme/sweeps/sweeps.hpp"
#include "meshes/deformed_cells.hpp"
#include "meshes/shape_integrals.hpp"
#include "sph/sph_graph.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <random>

namespace diptych {
namespace {

using algebra::Mat3;
using algebra::Vec3;
using Displacements = std::vector<Vec3>;

cases::MaterialCase rubber(double nu) {
  cases::MaterialCase m;
  m.density = 1000;
  m.shear_modulus = 1;
  m.lame = 2 * nu / (1 - 2 * nu);
  m.zeta_ratio = 0.5;
  return m;
}

using scheme::Volumes;

/// "sph lines" is SPH that sums by parts, whose lines carry the pressure.
scheme::PairGraph graph_for(const std::string& method, const meshes::Mesh& mesh) {
  if (method != "sph lines") {
    cases::Case setup = tests::second_order();
    setup.scheme.volumes = "cells";
    return tests::graph_of(method, mesh, setup);
  }
  sph::Options options;
  options.gradient = "sbp";
  return sph::build_graph(mesh, options);
}

Volumes safe_for(const std::string& method) {
  return method == "sph lines" ? Volumes::lines : Volumes::cells;
}

/// Share of the shear modulus that gradients of cells carry by default, where they are.
double shear_for(Volumes volumes) {
  return volumes == Volumes::cells ? cases::SchemeCase().cell_shear * rubber(0).shear_modulus : 0;
}

/// A body at given displacements, without velocities.
class StaticBody {
 public:
  StaticBody(const meshes::Mesh& mesh, const std::string& method, double nu, Volumes volumes)
      : StaticBody(mesh, method, nu, volumes, shear_for(volumes)) {}
  StaticBody(const meshes::Mesh& mesh,
             const std::string& method,
             double nu,
             Volumes volumes,
             double cell_shear)
      : graph(graph_for(method, mesh)),
        material(run::model_menu().at("mooney-rivlin").model(rubber(nu))),
        body(graph, options(*material, volumes, cell_shear)),
        sweeps_(body, material, quiet(), 1) {}

  /// Internal forces  [N]
  Displacements forces(const Displacements& u) {
    put(u);
    sweeps_.sum_forces(body, false);
    Displacements T(u.size());
    for (size_t a = 0; a < u.size(); ++a) {
      for (int i = 0; i < 3; ++i)
        T[a][i] = body.T.at(static_cast<std::int64_t>(a), i);
    }
    return T;
  }
  double energy(const Displacements& u) {
    put(u);
    return scheme::balance(*material, body).strain;
  }

  scheme::PairGraph graph;
  std::shared_ptr<const scheme::MaterialModel> material;
  scheme::Body<3> body;

 private:
  static scheme::SweepOptions quiet() {
    scheme::SweepOptions options;
    options.dissipation_factor = 0;
    return options;
  }
  static scheme::BodyOptions options(const scheme::MaterialModel& material,
                                     Volumes volumes,
                                     double cell_shear) {
    scheme::BodyOptions options;
    options.rho_R = material.rho_R();
    options.unknowns = scheme::Unknowns::F;
    options.volumes = volumes;
    options.cell_shear = cell_shear;
    return options;
  }
  /// u, and F as its discrete gradient.
  void put(const Displacements& u) {
    const auto set = [&](auto& field, double factor) {
      for (size_t a = 0; a < u.size(); ++a) {
        for (int i = 0; i < 3; ++i)
          field.set(static_cast<std::int64_t>(a), i, factor * u[a][i]);
      }
    };
    set(body.u, 1);
    set(body.v, 1);
    if (!body.in_runs()) {
      for (size_t a = 0; a < u.size(); ++a) {
        for (int i = 0; i < 3; ++i)
          body.records.set(static_cast<std::int64_t>(a), scheme::NodeRecord<3>::v(false) + i,
                           u[a][i]);
      }
    }
    scheme::velocity_gradients(body, 0);
    for (std::int64_t a = 0; a < body.n_owned; ++a) {
      for (int k = 0; k < 9; ++k)
        body.F.set(a, k, body.records.at(a, scheme::NodeRecord<3>::L + k));
    }
    set(body.v, 0);
    sweeps_.strain_rates(body, {}, nullptr, 0);
  }
  scheme::Sweeps<3> sweeps_;
};

using Cells = std::array<int, 3>;

meshes::Mesh block(meshes::CellType type, double moved, const Cells& cells = {4, 4, 4}) {
  meshes::Mesh mesh = meshes::box(type, Vec3::Zero(), Vec3::Ones(), cells);
  if (moved > 0) meshes::perturb_interior(mesh, moved, 3);
  return mesh;
}

Displacements affine(const scheme::PairGraph& graph, const Mat3& F) {
  Displacements u;
  for (const Vec3& X : graph.X)
    u.push_back(F * X - X);
  return u;
}

Displacements noisy(Displacements u, double size) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-size, size);
  for (Vec3& x : u)
    x += Vec3(uniform(random), uniform(random), uniform(random));
  return u;
}

Mat3 sheared() {
  Mat3 F;
  F << 0.9, 0.2, -0.1, 0.05, 1.1, 0.1, -0.15, 0.1, 0.8;
  return F;
}

using enum meshes::CellType;

struct Kind {
  meshes::CellType type;
  double moved;
  const char* method;
  Cells cells{4, 4, 4};
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.method << ", type " << static_cast<int>(kind.type) << ", moved " << kind.moved;
}
class BulkVolumes : public testing::TestWithParam<Kind> {
 protected:
  meshes::Mesh mesh = block(GetParam().type, GetParam().moved, GetParam().cells);
  StaticBody body{mesh, GetParam().method, 0.49, safe_for(GetParam().method)};
};
class CellVolumes : public BulkVolumes {};
const auto kinds_of_cells = testing::Values(Kind{hexahedron, 0, "sph"},
                                            Kind{hexahedron, 0.25, "sph"},
                                            Kind{hexahedron, 0.25, "fvm"},
                                            Kind{tetrahedron, 0, "fvm"},
                                            Kind{tetrahedron, 0.2, "fvm"},
                                            Kind{prism, 0.2, "fvm"});
INSTANTIATE_TEST_SUITE_P(Cells, CellVolumes, kinds_of_cells);
INSTANTIATE_TEST_SUITE_P(Cells, BulkVolumes, kinds_of_cells);
// lines with a table of their own, and with blocks at both ends
INSTANTIATE_TEST_SUITE_P(Lines,
                         BulkVolumes,
                         testing::Values(Kind{hexahedron, 0, "sph lines"},
                                         Kind{hexahedron, 0, "sph lines", {9, 3, 7}}));

TEST_P(CellVolumes, AddUpToTheVolumeThatTheBoundaryEncloses) {
  const Displacements u = noisy(affine(body.graph, sheared()), 0.03);
  body.forces(u);
  const std::vector<double> J = body.body.bulk->ratios(body.body);
  double volume = 0;
  for (size_t a = 0; a < J.size(); ++a)
    volume += J[a] * body.body.bulk->reference(static_cast<std::int64_t>(a));
  double enclosed = 0;
  std::vector<Vec3> x = body.graph.X;
  for (size_t a = 0; a < x.size(); ++a)
    x[a] += u[a];
  for (const meshes::BoundaryFace& face : mesh.boundary_faces) {
    const auto shares = meshes::face_area_shares(face, x, meshes::Quadrature::exact);
    // the volume is homogeneous of degree three in the corners, and these are its derivatives
    for (int i = 0; i < face.n_nodes; ++i)
      enclosed += x[face.nodes[i]].dot(shares[i]) / 3;
  }
  double of_cells = 0;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c)
    of_cells += meshes::signed_volume(mesh, c, x);
  EXPECT_NEAR(volume, enclosed, 1e-13);
  EXPECT_NEAR(volume, of_cells, 1e-13);
}

TEST_P(BulkVolumes, AreThoseOfTheDeformationWhereItIsAffine) {
  body.forces(affine(body.graph, sheared()));
  for (const double J : body.body.bulk->ratios(body.body))
    EXPECT_NEAR(J, sheared().determinant(), 1e-13);
}

TEST_P(BulkVolumes, PushOnlyTheBoundaryWhereTheStateIsUniform) {
  const auto T = body.forces(affine(body.graph, sheared()));
  physics::Deformation<double> X = physics::deformation_of(algebra::to_tensor(sheared()));
  const Mat3 P = algebra::to_eigen(body.material->stress(X, {}));
  for (size_t a = 0; a < T.size(); ++a)
    EXPECT_LT((T[a] + P * body.graph.boundary_area[a]).norm(), 1e-11 * P.norm() / 16) << a;
}

TEST_P(BulkVolumes, KeepMomenta) {
  const Displacements u = noisy(affine(body.graph, sheared()), 0.03);
  const auto T = body.forces(u);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double size = 0;
  for (size_t a = 0; a < T.size(); ++a) {
    force += T[a];
    size += T[a].norm();
  }
  EXPECT_LT(force.norm(), 1e-14 * size);
  // of this pressure alone, and of the shear of cells: a second body with other moduli of both
  StaticBody softer(mesh, GetParam().method, 0.45, safe_for(GetParam().method), 0);
  const auto soft = softer.forces(u);
  for (size_t a = 0; a < T.size(); ++a)
    moment += (body.graph.X[a] + u[a]).cross(T[a] - soft[a]);
  EXPECT_LT(moment.norm(), 1e-13 * size);
}

// The force is the derivative of the energy: -dE = sum T . du for any small change.
TEST_P(BulkVolumes, ForceIsTheDerivativeOfTheEnergy) {
  const Displacements u = noisy(affine(body.graph, sheared()), 0.02);
  const Displacements direction = noisy(Displacements(u.size(), Vec3::Zero()), 1);
  const auto T = body.forces(u);
  double expected = 0;
  for (size_t a = 0; a < u.size(); ++a)
    expected -= T[a].dot(direction[a]);
  const auto energy = [&](double step) {
    Displacements moved = u;
    for (size_t a = 0; a < u.size(); ++a)
      moved[a] += step * direction[a];
    return body.energy(moved);
  };
  const double h = 1e-5;
  const double slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
  EXPECT_NEAR(slope, expected, 1e-8 * std::abs(expected));
}

// What cells carry of the shear is taken from the nodes: nothing is changed where the deformation
// is affine, turned bodies included.
TEST_P(CellVolumes, ShearOfCellsHasNoPartInAffineMotions) {
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

enum class Support { rollers, none };

/// Least eigenvalue of the second variation of the energy over the nodal volumes, with the sides
/// between rollers or free, in units of mu/h^2. Motions of a free rigid body are not counted.
double least_stiffness(StaticBody& body, double J, Support support) {
  const Displacements u = affine(body.graph, std::cbrt(J) * Mat3::Identity());
  std::vector<std::pair<size_t, int>> moves;  // node, component
  const double spacing = 1 / (std::cbrt(static_cast<double>(u.size())) - 1);
  for (size_t a = 0; a < u.size(); ++a) {
    for (int i = 0; i < 3; ++i) {
      const bool on_side = std::abs(std::abs(body.graph.X[a][i] - 0.5) - 0.5) < 1e-9;
      if (support == Support::none || !on_side) moves.emplace_back(a, i);
    }
  }
  const auto n = static_cast<Eigen::Index>(moves.size());
  Eigen::MatrixXd K(n, n);
  const double step = 1e-6;
  for (Eigen::Index q = 0; q < n; ++q) {
    const auto [b, j] = moves[static_cast<size_t>(q)];
    Displacements plus = u, minus = u;
    plus[b][j] += step;
    minus[b][j] -= step;
    const auto up = body.forces(plus), down = body.forces(minus);
    for (Eigen::Index p = 0; p < n; ++p) {
      const auto [a, i] = moves[static_cast<size_t>(p)];
      K(p, q) = -(up[a][i] - down[a][i]) / (2 * step) /
                std::sqrt(body.graph.Omega[a] * body.graph.Omega[b]);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (K + K.transpose()));
  return solver.eigenvalues()[support == Support::none ? 6 : 0] * spacing * spacing;
}

struct Mould {
  meshes::CellType type;
  double moved;
  const char* method;
  double nu, J;
  Cells cells{4, 4, 4};
};
void PrintTo(const Mould& m, std::ostream* out) {
  *out << m.method << ", type " << static_cast<int>(m.type) << ", moved " << m.moved << ", nu "
       << m.nu << ", J " << m.J;
}
class UniformPressure : public testing::TestWithParam<Mould> {};
INSTANTIATE_TEST_SUITE_P(All,
                         UniformPressure,
                         testing::Values(Mould{hexahedron, 0, "sph", 0.49, 0.95},
                                         Mould{hexahedron, 0, "sph", 0.49, 0.8},
                                         Mould{hexahedron, 0, "sph", 0.499, 0.95},
                                         Mould{hexahedron, 0, "sph", 0.45, 0.3},
                                         Mould{hexahedron, 0, "sph lines", 0.45, 0.3},
                                         Mould{hexahedron, 0, "sph lines", 0.499, 0.6},
                                         Mould{hexahedron, 0, "sph lines", 0.45, 0.5, {8, 3, 3}},
                                         Mould{hexahedron, 0.3, "sph", 0.49, 0.8},
                                         Mould{hexahedron, 0.3, "sph", 0.499, 0.6},
                                         Mould{hexahedron, 0.3, "fvm", 0.499, 0.6},
                                         Mould{tetrahedron, 0, "fvm", 0.499, 0.6},
                                         Mould{tetrahedron, 0.2, "fvm", 0.4999, 0.9}));

TEST_P(UniformPressure, IsAStrictMinimumInAMould) {
  const Mould& m = GetParam();
  StaticBody body(block(m.type, m.moved, m.cells), m.method, m.nu, safe_for(m.method));
  const double at_rest = least_stiffness(body, 1, Support::rollers);
  EXPECT_GT(at_rest, 0);
  EXPECT_GT(least_stiffness(body, m.J, Support::rollers), 0.5 * at_rest);
}

// Six motions of a rigid body and no other without force.
TEST_P(UniformPressure, LeavesAFreeBodyAtRestStable) {
  const Mould& m = GetParam();
  StaticBody body(block(m.type, m.moved, {3, 3, 3}), m.method, m.nu, safe_for(m.method));
  EXPECT_GT(least_stiffness(body, 1, Support::none), 1e-4);
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

// What these volumes are there for: with J of the nodes these bodies turn inside out.
TEST(NodalPressure, IsNoMinimumWhereDerivativesDoNotCommute) {
  StaticBody sph(block(hexahedron, 0), "sph", 0.49, Volumes::nodes);
  EXPECT_LT(least_stiffness(sph, 0.8, Support::rollers), -0.5);
  StaticBody tetrahedra(block(tetrahedron, 0), "fvm", 0.499, Volumes::nodes);
  EXPECT_LT(least_stiffness(tetrahedra, 0.95, Support::rollers), 0);
  // and where they do it is
  StaticBody lattice(block(hexahedron, 0), "fvm", 0.499, Volumes::nodes);
  EXPECT_GT(least_stiffness(lattice, 0.6, Support::rollers),
            0.5 * least_stiffness(lattice, 1, Support::rollers));
}

}  // namespace
}  // namespace diptych
