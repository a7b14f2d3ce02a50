#pragma once
/// A material with Maxwell branches at one point, for tests: total energy (3), response and stress,
/// with F, H and J as independent arguments; and the sets of random bodies the tests run over.

#include "common/physics/materials/isochoric_neo_hookean.hpp"
#include "common/physics/materials/mooney_rivlin.hpp"
#include "common/physics/maxwell_branch.hpp"
#include "common/physics/moduli.hpp"
#include "common/physics/viscous_evolution.hpp"
#include "common/physics/wave_speeds.hpp"
#include "tests/common/physics/random_states.hpp"

#include <vector>

namespace diptych::tests {

using physics::BranchState;
using physics::Deformation;
using physics::MaxwellBranch;
using physics::Response;

template <class Material>
struct Body {
  static constexpr bool has_H = Material::has_H;
  Material material;
  std::vector<MaxwellBranch> branches;
  std::vector<BranchState<double>> states;

  double energy(const Deformation<double>& X) const {
    double W = material.energy(X);
    for (size_t k = 0; k < branches.size(); ++k)
      W += physics::branch_energy<has_H>(branches[k], states[k], X);
    return W;
  }
  Response<double> response(const Deformation<double>& X) const {
    Response<double> r = material.response(X);
    for (size_t k = 0; k < branches.size(); ++k)
      physics::add_branch_response<has_H>(branches[k], states[k], X, r);
    return r;
  }
  Tensor<double> piola(const Deformation<double>& X) const {
    return physics::piola_stress<has_H>(response(X), X);
  }
  Tensor<double> piola(const Tensor<double>& F) const { return piola(physics::deformation_of(F)); }
};

/// Random moduli of order one Pa: the formulae are linear in them.
inline void set_random_moduli(physics::MooneyRivlin& m, RandomStates& random) {
  m = {random.uniform(0.2, 1), random.uniform(0.1, 1), random.uniform(0.2, 3)};
}
inline void set_random_moduli(physics::NeoHookean& m, RandomStates& random) {
  m = {random.uniform(0.2, 1), 0, random.uniform(0.2, 3)};
}
template <bool squared_J>
void set_random_moduli(physics::IsochoricNeoHookeanFamily<squared_J>& m, RandomStates& random) {
  m.mu = random.uniform(0.4, 2);
  m.kappa = m.mu * random.uniform(0.67, 4);  // nu >= 0
}

/// @param n_branches 0, 1, 2...
/// @param spread eigenvalues of A and S lie in [1/spread, spread]
template <class Material>
Body<Material> random_body(RandomStates& random, int n_branches, double spread) {
  Body<Material> body;
  set_random_moduli(body.material, random);
  for (int k = 0; k < n_branches; ++k) {
    MaxwellBranch branch;
    branch.xi = random.uniform(0.2, 2) * body.material.branch_xi();
    branch.tau_C = random.factor(10);
    branch.zeta = random.uniform(0.2, 2) * body.material.branch_zeta();
    branch.tau_G = random.factor(10);
    body.branches.push_back(branch);
    body.states.push_back({random.positive_definite(spread), random.positive_definite(spread)});
  }
  return body;
}

/// Virgin branch states A = S = I.
inline BranchState<double> virgin() {
  return {algebra::symmetric_identity<double>(), algebra::symmetric_identity<double>()};
}

}  // namespace diptych::tests
