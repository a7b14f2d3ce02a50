/// Volumes that carry the pressure, of deformed cells and by derivatives along lines (notes 3.9,
/// 3.10): what they are, what their forces keep, and that a uniformly compressed body is a strict
/// minimum of its energy.

#include "common/algebra/face_areas.hpp"
#include "meshes/deformed_cells.hpp"
#include "meshes/shape_integrals.hpp"
#include "tests/common/scheme/static_body.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

using namespace tests;
using enum meshes::CellType;

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

TEST_P(BulkVolumes, ForceIsTheDerivativeOfTheEnergy) {
  const Displacements u = noisy(affine(body.graph, sheared()), 0.02);
  const Displacements direction = noisy(Displacements(u.size(), Vec3::Zero()), 1);
  expect_derivative_of_energy(body, u, direction);
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
