#pragma once
/// A body's nodes one by one, outside of the sweeps.

#include "common/physics/maxwell_branch.hpp"
#include "common/scheme/body/body.hpp"

#include <vector>

namespace diptych::scheme {

/// {F, H, J} of one node, evolved or from F.
template <int Dim>
physics::Deformation<double> deformation_at(const Body<Dim>& body, std::int64_t a) {
  using algebra::Tensor;
  physics::Deformation<double> X;
  X.F = algebra::identity<double>();
  for (int k = 0; k < Dim * Dim; ++k)
    X.F(k / Dim, k % Dim) += body.F.at(a, k);
  const auto derived = physics::deformation_of(X.F);
  X.H = derived.H;
  X.J = derived.J;
  if (body.options.unknowns == Unknowns::FHJ) {
    X.H = algebra::identity<double>();
    for (int k = 0; k < Dim * Dim; ++k)
      X.H(k / Dim, k % Dim) += body.H(a, k);
    if constexpr (Dim == 2) X.H(2, 2) += body.H(a, 4);
  }
  if (!body.J.empty()) X.J = 1 + body.J.at(a, 0);
  return X;
}

/// Internal variables of all branches at node a; identity where not stored.
template <int Dim>
std::vector<physics::BranchState<double>> branches_at(const Body<Dim>& body, std::int64_t a) {
  using Layout = algebra::Layout<Dim>;
  const auto I = algebra::symmetric_identity<double>();
  std::vector<physics::BranchState<double>> branches(body.options.n_branches, {I, I});
  for (int k = 0; k < body.options.n_branches; ++k) {
    for (int c = 0; c < Layout::n_A; ++c)
      branches[k].A.s[algebra::order_of_A<Dim>[c]] += body.A.at(a, k * Layout::n_A + c);
    if (body.S.empty()) continue;
    for (int c = 0; c < Layout::n_S; ++c)
      branches[k].S.s[algebra::order_of_S<Dim>[c]] += body.S.at(a, k * Layout::n_S + c);
  }
  return branches;
}

}  // namespace diptych::scheme
