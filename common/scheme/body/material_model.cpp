#include "common/scheme/body/material_model.hpp"

#include "common/physics/wave_speeds.hpp"

namespace diptych::scheme {

double MaterialModel::energy(const PointDeformation& X, const PointBranches& states) const {
  double W = energy(X);
  for (size_t k = 0; k < branches_.size(); ++k) {
    W += has_H_ ? physics::branch_energy<true>(branches_[k], states[k], X)
                : physics::branch_energy<false>(branches_[k], states[k], X);
  }
  return W;
}

physics::Response<double> MaterialModel::response(const PointDeformation& X,
                                                  const PointBranches& states) const {
  physics::Response<double> sum = response(X);
  for (size_t k = 0; k < branches_.size(); ++k) {
    if (has_H_) {
      physics::add_branch_response<true>(branches_[k], states[k], X, sum);
    } else {
      physics::add_branch_response<false>(branches_[k], states[k], X, sum);
    }
  }
  return sum;
}

algebra::Tensor<double> MaterialModel::stress(const PointDeformation& X,
                                              const PointBranches& states) const {
  const physics::Response<double> r = response(X, states);
  return has_H_ ? physics::piola_stress<true>(r, X) : physics::piola_stress<false>(r, X);
}

double MaterialModel::dissipation(const PointDeformation& X, const PointBranches& states) const {
  const auto now = physics::right_tensors(X.F);
  double D = 0;
  for (size_t k = 0; k < branches_.size(); ++k) {
    D += has_H_ ? physics::branch_dissipation<true>(branches_[k], states[k], now)
                : physics::branch_dissipation<false>(branches_[k], states[k], now);
  }
  return D;
}

PointBranches MaterialModel::virgin() const {
  const auto I = algebra::symmetric_identity<double>();
  return {branches_.size(), physics::BranchState<double>{I, I}};
}

double MaterialModel::undeformed_speed() const {
  PointDeformation X;
  X.F = X.H = algebra::identity<double>();
  X.J = 1;
  return physics::speed_bounds(response(X, virgin()), X, rho_R_, has_H_, has_W_FJ_).c_p;
}

}  // namespace diptych::scheme
