/// What holds displacements that F of the nodes does not see (scheme/hourglass, notes 3.12).

#include "tests/common/scheme/static_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych {
namespace {

using namespace tests;
using enum meshes::CellType;

class Hourglass : public testing::TestWithParam<Kind> {
 protected:
  StaticBody body_with(double modulus) const {
    const Kind& kind = GetParam();
    return {block(kind.type, kind.moved, kind.cells), kind.method, 0.3, Volumes::nodes, 0, modulus};
  }
};
INSTANTIATE_TEST_SUITE_P(All,
                         Hourglass,
                         testing::Values(Kind{hexahedron, 0.2, "sph sbp"},
                                         Kind{hexahedron, 0.2, "fvm sbp"},
                                         Kind{tetrahedron, 0.2, "sph sbp"},
                                         Kind{tetrahedron, 0.2, "fvm sbp"}));

Displacements quadratic(const scheme::PairGraph& graph) {
  Displacements u = affine(graph, sheared());
  for (size_t a = 0; a < u.size(); ++a) {
    const Vec3& X = graph.X[a];
    u[a] += 0.1 * Vec3(X[0] * X[1], X[2] * X[2] - X[0] * X[0], X[1] * X[2]);
  }
  return u;
}

// Rows are exact for quadratics to what the solve leaves.
TEST_P(Hourglass, HasNoPartInQuadraticMotionsOfTurnedBodies) {
  StaticBody with = body_with(5), without = body_with(0);
  ASSERT_FALSE(with.graph.edges.empty());
  const Displacements u = quadratic(with.graph);
  const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  Displacements turned = u;
  for (size_t a = 0; a < u.size(); ++a)
    turned[a] = turn * (with.graph.X[a] + u[a]) - with.graph.X[a];
  for (const Displacements& motion : {u, turned})
    EXPECT_NEAR(with.energy(motion), without.energy(motion), 1e-8);
  const Displacements noise = noisy(turned, 0.01);
  EXPECT_GT(with.energy(noise), without.energy(noise) + 1e-3);
}

TEST_P(Hourglass, ForceIsTheDerivativeOfTheEnergy) {
  StaticBody body = body_with(5);
  const Displacements u = noisy(affine(body.graph, sheared()), 0.02);
  const Displacements direction = noisy(Displacements(u.size(), Vec3::Zero()), 1);
  expect_derivative_of_energy(body, u, direction);
}

TEST_P(Hourglass, KeepsMomentumAndAngularMomentum) {
  StaticBody body = body_with(5);
  const Displacements u = noisy(affine(body.graph, sheared()), 0.02);
  const auto T = body.forces(u);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  double size = 0;
  for (size_t a = 0; a < u.size(); ++a) {
    force += T[a];
    torque += (body.graph.X[a] + u[a]).cross(T[a]);
    size += T[a].norm();
  }
  EXPECT_LT(force.norm(), 1e-13 * size);
  EXPECT_LT(torque.norm(), 1e-12 * size);
}

// A wave from node to node, of which rows see little: nodes leave it two to five times softer.
TEST_P(Hourglass, HoldsWavesFromNodeToNode) {
  StaticBody with = body_with(5), without = body_with(0);
  Displacements wave;
  for (const Vec3& X : with.graph.X) {
    const auto place = [&](int i) { return std::lround(4 * X[i]); };
    const bool is_even = (place(0) + place(1) + place(2)) % 2 == 0;
    wave.emplace_back(is_even ? 1e-4 : -1e-4, 0, 0);
  }
  EXPECT_GT(with.energy(wave), 2 * without.energy(wave));
}

}  // namespace
}  // namespace diptych
