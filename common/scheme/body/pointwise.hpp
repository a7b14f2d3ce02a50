#pragma once
/// Pointwise part of an evaluation for one block of eight nodes: deformation as stored, internal
/// variables relaxed to the evaluation's time, response with all branches. Shared by the sweep that
/// feeds the momentum equation, the energy audit and the snapshot.

#include "common/scheme/body/body.hpp"
#include "common/scheme/body/model.hpp"
#include "common/scheme/body/relaxation.hpp"

namespace diptych::scheme {

using algebra::get_tensor;
using algebra::Lanes;
using algebra::n_lanes;
using algebra::NodeTable;
using algebra::put_tensor;
using algebra::SymmetricTensor;
using algebra::Tensor;
using physics::BranchState;
using physics::Deformation;
using physics::Response;

/// dF/dt of block b.
template <int Dim>
DIPTYCH_INLINE Tensor<Lanes> velocity_gradient(const Body<Dim>& body, std::int64_t b) {
  if (body.options.has_slopes) return get_tensor<Dim>(body.rates, b, 0);
  return get_tensor<Dim>(body.records, b, NodeRecord<Dim>::L);
}
template <int Dim>
DIPTYCH_INLINE void put_velocity_gradient(Body<Dim>& body,
                                          std::int64_t b,
                                          const Lanes (&L)[Dim * Dim]) {
  const auto put = [&](int k) DIPTYCH_INLINE_LAMBDA { return L[k]; };
  if (body.options.has_slopes) {
    body.rates.template put_each<Dim * Dim>(b, 0, put);
  } else {
    body.records.template put_each<Dim * Dim>(b, NodeRecord<Dim>::L, put);
  }
}

/// H of block b, where it is evolved.
template <int Dim>
DIPTYCH_INLINE void put_H(Body<Dim>& body, std::int64_t b, const Tensor<Lanes>& H) {
  put_tensor<Dim>(body.records, b, NodeRecord<Dim>::H, H, 1);
  if constexpr (Dim == 2) body.H_33.put(b, 0, H(2, 2) - 1.0);
}

/// {F, H, J} of a block: evolved where they are unknowns, from F otherwise.
template <int Dim>
DIPTYCH_INLINE Deformation<Lanes> load_deformation(const Body<Dim>& body, std::int64_t b) {
  Deformation<Lanes> X;
  X.F = get_tensor<Dim>(body.F, b, 0, 1);
  if (body.options.unknowns == Unknowns::FHJ) {
    X.H = get_tensor<Dim>(body.records, b, NodeRecord<Dim>::H, 1);
    if constexpr (Dim == 2) X.H(2, 2) = body.H_33.get(b, 0) + 1.0;
    X.J = body.J.get(b, 0) + 1.0;
  } else {
    X.H = algebra::cofactor(X.F);
    X.J = body.options.unknowns == Unknowns::FJ ? body.J.get(b, 0) + 1.0
                                                : algebra::determinant(X.F, X.H);
  }
  return X;
}

/// What drives the relaxation over a step: C^-1, G^-1 at two times.
struct RelaxationDrive {
  SymmetricTensor<Lanes> C_first, C_second, G_first, G_second;
};

/// From the beginning of the step to now: the same for all branches.
template <int Dim>
DIPTYCH_INLINE RelaxationDrive linear_drive(const Body<Dim>& body,
                                            const physics::RightTensors<Lanes>& now,
                                            std::int64_t b) {
  const auto begin = physics::right_tensors(get_tensor<Dim>(body.F_0, b, 0, 1));
  return {begin.inverse_C, now.inverse_C, begin.inverse_G, now.inverse_G};
}

/// At the times of a Gauss rule.
template <int Dim>
DIPTYCH_INLINE RelaxationDrive gauss_drive(const Body<Dim>& body,
                                           const physics::GaussRelaxation& rule,
                                           double dt,
                                           std::int64_t b) {
  const Tensor<Lanes> F_0 = get_tensor<Dim>(body.F_0, b, 0, 1);
  const Tensor<Lanes> F = get_tensor<Dim>(body.F, b, 0, 1);
  const Tensor<Lanes> L_0 = get_tensor<Dim>(body.L_0, b, 0);
  const Tensor<Lanes> L = velocity_gradient(body, b);
  const auto at = [&](double theta) DIPTYCH_INLINE_LAMBDA {
    return physics::right_tensors(physics::hermite(theta, dt, F_0, L_0, F, L));
  };
  const auto first = at(rule.theta[0]), second = at(rule.theta[1]);
  return {first.inverse_C, second.inverse_C, first.inverse_G, second.inverse_G};
}

/// Internal variables of branch k as they are stored.
template <int Dim, bool has_H>
DIPTYCH_INLINE BranchState<Lanes> stored_branch(const Body<Dim>& body, std::int64_t b, int k) {
  using Layout = algebra::Layout<Dim>;
  BranchState<Lanes> branch;
  branch.A = algebra::get_A<Dim>(body.A, b, k * Layout::n_A);
  branch.S = has_H ? algebra::get_S<Dim>(body.S, b, k * Layout::n_S)
                   : algebra::symmetric_identity<Lanes>();
  return branch;
}

/// Internal variables of branch k at the time of the evaluation.
template <int Dim, bool has_H>
DIPTYCH_INLINE BranchState<Lanes> relaxed_branch(const Body<Dim>& body,
                                                 const Relaxation& relaxation,
                                                 const RelaxationDrive& linear,
                                                 std::int64_t b,
                                                 int k) {
  BranchState<Lanes> branch = stored_branch<Dim, has_H>(body, b, k);
  if (relaxation.rule == Relaxation::Rule::linear) {
    branch.A = physics::relaxed(relaxation.linear_C[k], branch.A, linear.C_first, linear.C_second);
    if constexpr (has_H)
      branch.S =
          physics::relaxed(relaxation.linear_G[k], branch.S, linear.G_first, linear.G_second);
  } else if (relaxation.rule == Relaxation::Rule::gauss) {
    const auto& rule_C = relaxation.gauss_C[k];
    const auto C = gauss_drive(body, rule_C, relaxation.dt, b);
    branch.A = physics::relaxed(rule_C, branch.A, C.C_first, C.C_second);
    if constexpr (has_H) {
      const auto& rule_G = relaxation.gauss_G[k];
      const auto G = gauss_drive(body, rule_G, relaxation.dt, b);
      branch.S = physics::relaxed(rule_G, branch.S, G.G_first, G.G_second);
    }
  }
  return branch;
}

/// C and G over the step that ends now: the third order of the Hermite cubic of F where its rates
/// at both ends are kept, the second without.
template <int Dim, bool has_H>
DIPTYCH_INLINE physics::StepPaths<Lanes> paths_of_step(const Body<Dim>& body,
                                                       const Relaxation& relaxation,
                                                       const physics::RightTensors<Lanes>& now,
                                                       std::int64_t b) {
  const Tensor<Lanes> F_0 = get_tensor<Dim>(body.F_0, b, 0, 1);
  const bool with_rates = relaxation.rule == Relaxation::Rule::gauss;
  Tensor<Lanes> F{}, rate_0{}, rate{};
  if (with_rates) {
    F = get_tensor<Dim>(body.F, b, 0, 1);
    rate_0 = relaxation.dt * get_tensor<Dim>(body.L_0, b, 0);
    rate = relaxation.dt * velocity_gradient(body, b);
  }
  return physics::step_paths<has_H>(physics::right_tensors(F_0), now, with_rates, F_0, rate_0, F,
                                    rate);
}

/// What branch k has dissipated over the step that ends now  [J/m^3]
template <int Dim, bool has_H>
DIPTYCH_INLINE Lanes dissipation_of_step(const Body<Dim>& body,
                                         const physics::MaxwellBranch& branch,
                                         const Relaxation& relaxation,
                                         const physics::StepPaths<Lanes>& paths,
                                         const BranchState<Lanes>& end,
                                         std::int64_t b,
                                         int k) {
  const BranchState<Lanes> begin = stored_branch<Dim, has_H>(body, b, k);
  Lanes D = branch.xi * physics::released(relaxation.excess_C[k], paths.C, begin.A, end.A);
  if constexpr (has_H) {
    D += branch.zeta * physics::released(relaxation.excess_G[k], paths.G, begin.S, end.S);
  }
  return D;
}

/// Response of a block with all branches; per branch calls visit(k, branch state, C and G now).
template <int Dim, class Material, class Visit>
DIPTYCH_INLINE Response<Lanes> response_of_block(const Model<Material>& model,
                                                 const Body<Dim>& body,
                                                 const Relaxation& relaxation,
                                                 const Deformation<Lanes>& X,
                                                 std::int64_t b,
                                                 const Visit& visit) {
  constexpr bool has_H = Material::has_H;
  Response<Lanes> response = model.material.response(X);
  const int n_branches = body.options.n_branches;
  if (n_branches == 0) return response;
  const auto now = physics::right_tensors(X.F);
  RelaxationDrive linear;
  if (relaxation.rule == Relaxation::Rule::linear) linear = linear_drive(body, now, b);
  for (int k = 0; k < n_branches; ++k) {
    const BranchState<Lanes> branch = relaxed_branch<Dim, has_H>(body, relaxation, linear, b, k);
    physics::add_branch_response<has_H>(model.branches[k], branch, X, response);
    visit(k, branch, now);
  }
  return response;
}

}  // namespace diptych::scheme
