/// What holds displacements that F of the nodes does not see (scheme/hourglass, notes 3.12).

#include "tests/common/scheme/static_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

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

/// The budget of leapfrog takes this power for the rate of the energy.
template <int Dim>
void expect_power_of_energy(StaticBodyIn<Dim> body, Displacements u, Displacements v) {
  auto& control = *body.body.hourglass;
  const auto energy = [&](double step) {
    Displacements moved = u;
    for (size_t a = 0; a < u.size(); ++a)
      moved[a] += step * v[a];
    body.forces(moved);
    std::vector<double> sums(static_cast<size_t>(parallel::n_chunks_of(body.body.n_blocks)));
    control.add_energies(body.body, sums);
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  };
  const double h = 1e-5, slope = (energy(h) - energy(-h)) / (2 * h);
  body.forces(u);
  for (size_t a = 0; a < u.size(); ++a) {
    for (int i = 0; i < Dim; ++i) {
      body.body.v.set(static_cast<std::int64_t>(a), i, v[a][i]);
      if (!body.body.in_runs())
        body.body.records.set(static_cast<std::int64_t>(a), scheme::NodeRecord<Dim>::v(false) + i,
                              v[a][i]);
    }
  }
  scheme::velocity_gradients(body.body, 0);
  EXPECT_NEAR(control.power(body.body), -slope, 1e-7 * std::abs(slope));
}

TEST_P(Hourglass, HasThePowerOfItsEnergy) {
  StaticBody body = body_with(5);
  const Displacements u = noisy(affine(body.graph, sheared()), 0.02);
  const Displacements v = noisy(quadratic(body.graph), 0.1);
  expect_power_of_energy<3>(std::move(body), u, v);
}

TEST(HourglassInThePlane, HasThePowerOfItsEnergy) {
  for (const auto type : {quadrilateral, triangle}) {
    for (const char* method : {"sph sbp", "fvm sbp"}) {
      StaticBodyIn<2> body(block(type, 0.2, {6, 6, 1}), method, 0.3, Volumes::nodes, 0, 5);
      ASSERT_FALSE(body.graph.edges.empty());
      Displacements u, v;
      for (const Vec3& X : body.graph.X) {
        u.emplace_back(0.02 * std::sin(40 * X[0] + 30 * X[1]), 0.03 * std::cos(50 * X[1]), 0);
        v.emplace_back(std::cos(60 * X[0]), std::sin(45 * X[1] + 20 * X[0]), 0);
      }
      expect_power_of_energy<2>(std::move(body), u, v);
    }
  }
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
