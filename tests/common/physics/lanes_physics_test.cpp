/// The formulae of physics over eight lanes against the same formulae over doubles.

#include "tests/common/physics/body.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace diptych::tests {
namespace {

using algebra::Lanes;
using algebra::n_lanes;

// Same operations in the same order; where the compiler fuses multiply-adds it may do so in one of
// the two only. 4 ulp of the largest term of a sum.
constexpr double four_ulp = 4 * std::numeric_limits<double>::epsilon();

template <class Packed, class Scalar>
void set_lane(Packed& packed, int lane, const Scalar& scalar) {
  constexpr int n = sizeof(Scalar) / sizeof(double);
  const auto* from = reinterpret_cast<const double*>(&scalar);
  auto* to = reinterpret_cast<double*>(&packed);
  for (int k = 0; k < n; ++k)
    to[k * n_lanes + lane] = from[k];
}
template <class Scalar, class Packed>
Scalar lane_of(const Packed& packed, int lane) {
  static_assert(sizeof(Packed) == n_lanes * sizeof(Scalar));
  Scalar scalar;
  auto* to = reinterpret_cast<double*>(&scalar);
  const auto* from = reinterpret_cast<const double*>(&packed);
  for (size_t k = 0; k < sizeof(Scalar) / sizeof(double); ++k)
    to[k] = from[k * n_lanes + lane];
  return scalar;
}

template <class Material>
class LanesOfPhysics : public testing::Test {};
using Materials = testing::Types<physics::MooneyRivlin,
                                 physics::NeoHookean,
                                 physics::IsochoricNeoHookean,
                                 physics::IsochoricNeoHookeanJ2>;
TYPED_TEST_SUITE(LanesOfPhysics, Materials);

TYPED_TEST(LanesOfPhysics, GiveTheAnswersOfDoubles) {
  constexpr bool has_H = TypeParam::has_H;
  RandomStates random(91);
  for (int n = 0; n < 50; ++n) {
    auto body = random_body<TypeParam>(random, 1, 3);
    const auto& branch = body.branches[0];
    BranchState<double> state[n_lanes];
    Tensor<double> F[n_lanes];
    Vector<double> N[n_lanes];
    BranchState<Lanes> states;
    Tensor<Lanes> Fs;
    Vector<Lanes> Ns;
    for (int i = 0; i < n_lanes; ++i) {
      state[i] = {random.positive_definite(3), random.positive_definite(3)};
      F[i] = random.deformation_gradient(2);
      N[i] = random.direction();
      set_lane(states, i, state[i]);
      set_lane(Fs, i, F[i]);
      set_lane(Ns, i, N[i]);
    }
    const auto Xs = physics::deformation_of(Fs);
    auto rs = body.material.response(Xs);
    physics::add_branch_response<has_H>(branch, states, Xs, rs);
    const auto Ps = physics::piola_stress<has_H>(rs, Xs);
    const auto Qs = physics::acoustic_tensor(rs, Xs, Ns);
    const auto Zs = physics::impedance<has_H>(rs, Xs, 1100, Ns);
    const auto cs = physics::wave_speeds(rs, Xs, 1100, Ns);
    const auto bounds = physics::speed_bounds(rs, Xs, 1100, has_H, true);
    const Lanes Ws = body.material.energy(Xs) + physics::branch_energy<has_H>(branch, states, Xs);
    const Lanes Ds =
        physics::branch_dissipation<has_H>(branch, states, physics::right_tensors(Xs.F));
    const auto w = physics::gauss_relaxation(0.7);
    const auto As = physics::relaxed(w, states.A, physics::inverse_C(Xs), physics::inverse_G(Xs));
    for (int i = 0; i < n_lanes; ++i) {
      body.states[0] = state[i];
      const auto X = physics::deformation_of(F[i]);
      const auto r = body.response(X);
      const auto close = [](const auto& a, const auto& b) {
        EXPECT_LT(distance(a, b), four_ulp * algebra::to_eigen(b).norm());
      };
      // P adds Sigma_F, Sigma_H x F and Sigma_J H, which cancel in part
      const auto P = body.piola(X);
      const double terms = algebra::to_eigen(r.Sigma_F).norm() +
                           algebra::to_eigen(r.Sigma_H).norm() * algebra::to_eigen(F[i]).norm() +
                           std::abs(r.Sigma_J) * algebra::to_eigen(X.H).norm();
      EXPECT_LT(distance(lane_of<Tensor<double>>(Ps, i), P), four_ulp * terms);
      close(lane_of<SymmetricTensor<double>>(Qs, i), physics::acoustic_tensor(r, X, N[i]));
      close(lane_of<SymmetricTensor<double>>(Zs, i), physics::impedance<has_H>(r, X, 1100, N[i]));
      const auto c = physics::wave_speeds(r, X, 1100, N[i]);
      EXPECT_NEAR(cs.c_p[i], c.c_p, four_ulp * c.c_p);
      EXPECT_NEAR(cs.c_s1[i], c.c_s1, four_ulp * c.c_p);
      EXPECT_NEAR(cs.c_s2[i], c.c_s2, four_ulp * c.c_p);
      const auto bound = physics::speed_bounds(r, X, 1100, has_H, true);
      EXPECT_NEAR(bounds.c_p[i], bound.c_p, four_ulp * bound.c_p);
      EXPECT_NEAR(bounds.c_s[i], bound.c_s, four_ulp * bound.c_s);
      const double W = body.energy(X);
      EXPECT_NEAR(Ws[i], W, four_ulp * (W + terms));
      const double D =
          physics::branch_dissipation<has_H>(branch, state[i], physics::right_tensors(X.F));
      EXPECT_NEAR(Ds[i], D,
                  four_ulp * (D + 6 * (branch.xi / branch.tau_C + branch.zeta / branch.tau_G)));
      close(lane_of<SymmetricTensor<double>>(As, i),
            physics::relaxed(w, state[i].A, physics::inverse_C(X), physics::inverse_G(X)));
    }
  }
}

}  // namespace
}  // namespace diptych::tests
