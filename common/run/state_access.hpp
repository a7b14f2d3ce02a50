#pragma once
/// A state from outside the hot loops: initial values, snapshot, hash, and reports of a breakdown.

#include "common/run/solver.hpp"
#include "common/scheme/body/model.hpp"
#include "common/scheme/body/state.hpp"

#include <cmath>
#include <numeric>

namespace diptych::run {

using algebra::Mat3;

/// Reference positions about the centre of volume.
std::vector<algebra::Vec3> centred(const scheme::PairGraph& graph);

/// u and v from their expressions, F as the discrete gradient sum 1/2 (x_b - x_a) (x) C_ab /
/// Omega_a (or as given), H and J from F, internal variables virgin or relaxed.
template <int Dim>
void set_initial_state(const scheme::PairGraph& graph,
                       const cases::InitialCase& initial,
                       double kappa_f,
                       scheme::State<Dim>& state);

/// 32 hexadecimal digits.
template <int Dim>
std::string hash_of(const scheme::State<Dim>& state,
                    const std::vector<std::int32_t>& order,
                    double time);

/// The first node that is not finite or has J <= 0: node, place, time, state, suspected cause.
std::string breakdown_report(const Snapshot& snapshot,
                             const scheme::PairGraph& graph,
                             std::int64_t step,
                             double dt);

template <int Dim>
std::string collapse_report(const scheme::State<Dim>& state,
                            const scheme::PairGraph& graph,
                            std::int64_t step,
                            double time,
                            double dt,
                            double first_dt);

/// {F, H, J} of one node, evolved or from F.
template <int Dim>
physics::Deformation<double> deformation_at(const scheme::State<Dim>& state, std::int64_t a) {
  using algebra::Tensor;
  physics::Deformation<double> X;
  X.F = algebra::identity<double>();
  for (int k = 0; k < Dim * Dim; ++k)
    X.F(k / Dim, k % Dim) += state.F.at(a, k);
  const auto derived = physics::deformation_of(X.F);
  X.H = derived.H;
  X.J = derived.J;
  if (state.unknowns == scheme::Unknowns::FHJ) {
    X.H = algebra::identity<double>();
    for (int k = 0; k < Dim * Dim; ++k)
      X.H(k / Dim, k % Dim) += state.H(a, k);
    if constexpr (Dim == 2) X.H(2, 2) += state.H(a, 4);
  }
  if (!state.J.empty()) X.J = 1 + state.J.at(a, 0);
  return X;
}

/// Internal variables of branch k at node a; identity where not stored.
template <int Dim>
physics::BranchState<double> branch_at(const scheme::State<Dim>& state, std::int64_t a, int k) {
  using Layout = algebra::Layout<Dim>;
  physics::BranchState<double> branch{algebra::symmetric_identity<double>(),
                                      algebra::symmetric_identity<double>()};
  for (int c = 0; c < Layout::n_A; ++c)
    branch.A.s[algebra::order_of_A<Dim>[c]] += state.A.at(a, k * Layout::n_A + c);
  if (state.S.empty()) return branch;
  for (int c = 0; c < Layout::n_S; ++c)
    branch.S.s[algebra::order_of_S<Dim>[c]] += state.S.at(a, k * Layout::n_S + c);
  return branch;
}

template <int Dim, class Material>
Snapshot snapshot_of(const scheme::Model<Material>& model,
                     const scheme::State<Dim>& state,
                     double time,
                     std::span<const std::int32_t> nodes) {
  Snapshot s;
  s.time = time;
  const size_t n = nodes.size();
  s.u.assign(n, algebra::Vec3::Zero());
  s.v.assign(n, algebra::Vec3::Zero());
  s.F.resize(n);
  s.H.resize(n);
  s.P.resize(n);
  s.J.resize(n);
  s.A.assign(state.n_branches, std::vector<Mat3>(n));
  s.S.assign(state.S.empty() ? 0 : state.n_branches, std::vector<Mat3>(n));
  for (size_t k = 0; k < n; ++k) {
    const std::int32_t a = nodes[k];
    for (int i = 0; i < Dim; ++i) {
      s.u[k][i] = state.u.at(a, i);
      s.v[k][i] = state.v.at(a, i);
    }
    const auto X = deformation_at(state, a);
    auto response = model.material.response(X);
    for (int r = 0; r < state.n_branches; ++r) {
      const auto branch = branch_at(state, a, r);
      physics::add_branch_response<Material::has_H>(model.branches[r], branch, X, response);
      s.A[r][k] = algebra::to_eigen(branch.A);
      if (!s.S.empty()) s.S[r][k] = algebra::to_eigen(branch.S);
    }
    s.F[k] = algebra::to_eigen(X.F);
    s.H[k] = algebra::to_eigen(X.H);
    s.J[k] = X.J;
    s.P[k] = algebra::to_eigen(physics::piola_stress<Material::has_H>(response, X));
  }
  return s;
}

/// Of all nodes.
template <int Dim, class Material>
Snapshot snapshot_of(const scheme::Model<Material>& model,
                     const scheme::State<Dim>& state,
                     double time) {
  std::vector<std::int32_t> nodes(state.n_nodes);
  std::iota(nodes.begin(), nodes.end(), 0);
  return snapshot_of(model, state, time, std::span<const std::int32_t>(nodes));
}

}  // namespace diptych::run
