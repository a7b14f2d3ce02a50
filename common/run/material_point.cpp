#include "common/run/material_point.hpp"

#include "common/physics/step_dissipation.hpp"
#include "common/physics/viscous_evolution.hpp"
#include "common/physics/wave_speeds.hpp"
#include "common/run/model_menu.hpp"

namespace diptych::run {

namespace {

using physics::deformation_of;
using physics::inverse_C;
using physics::inverse_G;

physics::Deformation<double> deformation(const Mat3& F) {
  return deformation_of(algebra::to_tensor(F));
}

}  // namespace

Mat3 MaterialPoint::stress(const PointState& state) const {
  return algebra::to_eigen(material_->stress(deformation(state.F), state.branches));
}

double MaterialPoint::energy(const PointState& state) const {
  return material_->energy(deformation(state.F), state.branches);
}

double MaterialPoint::dissipation(const PointState& state) const {
  return material_->dissipation(deformation(state.F), state.branches);
}

double MaterialPoint::dissipation_of_step(const PointState& begin,
                                          const PointState& end,
                                          double dt,
                                          const std::optional<std::array<Mat3, 2>>& rates) const {
  const auto F_0 = algebra::to_tensor(begin.F), F_1 = algebra::to_tensor(end.F);
  const auto rate = [&](size_t end_of_step) {
    return algebra::to_tensor(rates ? Mat3(dt * (*rates)[end_of_step]) : Mat3(Mat3::Zero()));
  };
  const auto paths =
      physics::step_paths<true>(physics::right_tensors(F_0), physics::right_tensors(F_1),
                                rates.has_value(), F_0, rate(0), F_1, rate(1));
  double dissipated = 0;
  for (size_t k = 0; k < branches().size(); ++k) {
    const physics::MaxwellBranch& b = branches()[k];
    dissipated += b.xi * physics::released(physics::excess_weights(dt / b.tau_C), paths.C,
                                           begin.branches[k].A, end.branches[k].A);
    dissipated += b.zeta * physics::released(physics::excess_weights(dt / b.tau_G), paths.G,
                                             begin.branches[k].S, end.branches[k].S);
  }
  return dissipated;
}

Mat3 MaterialPoint::acoustic_tensor(const PointState& state, const Vec3& N) const {
  const auto X = deformation(state.F);
  const auto response = material_->response(X, state.branches);
  return algebra::to_eigen(physics::acoustic_tensor(response, X, {{N[0], N[1], N[2]}}));
}

MaterialPoint make_material_point(const cases::MaterialCase& material) {
  return MaterialPoint(model_menu().at(material.model).model(material));
}

PointState MaterialPoint::virgin(const Mat3& F) const {
  return {F, material_->virgin()};
}

std::vector<PointBranch> MaterialPoint::branch_rates(const PointState& state) const {
  const auto X = deformation(state.F);
  std::vector<PointBranch> rates;
  for (size_t k = 0; k < branches().size(); ++k) {
    const PointBranch& b = state.branches[k];
    rates.push_back({(1 / branches()[k].tau_C) * (inverse_C(X) + (-1.0) * b.A),
                     (1 / branches()[k].tau_G) * (inverse_G(X) + (-1.0) * b.S)});
  }
  return rates;
}

std::vector<PointBranch> MaterialPoint::relaxed_linear(const PointState& state,
                                                       const Mat3& F_end,
                                                       double dt) const {
  const auto X = deformation(state.F), Y = deformation(F_end);
  std::vector<PointBranch> after;
  for (size_t k = 0; k < branches().size(); ++k) {
    const auto w_C = physics::linear_relaxation(dt / branches()[k].tau_C);
    const auto w_G = physics::linear_relaxation(dt / branches()[k].tau_G);
    const PointBranch& b = state.branches[k];
    after.push_back({physics::relaxed(w_C, b.A, inverse_C(X), inverse_C(Y)),
                     physics::relaxed(w_G, b.S, inverse_G(X), inverse_G(Y))});
  }
  return after;
}

std::vector<PointBranch> MaterialPoint::relaxed_gauss(const PointState& state,
                                                      const Mat3& rate_begin,
                                                      const Mat3& F_end,
                                                      const Mat3& rate_end,
                                                      double dt) const {
  const auto at = [&](double theta) {
    return deformation_of(
        physics::hermite(theta, dt, algebra::to_tensor(state.F), algebra::to_tensor(rate_begin),
                         algebra::to_tensor(F_end), algebra::to_tensor(rate_end)));
  };
  std::vector<PointBranch> after;
  for (size_t k = 0; k < branches().size(); ++k) {
    const auto w_C = physics::gauss_relaxation(dt / branches()[k].tau_C);
    const auto w_G = physics::gauss_relaxation(dt / branches()[k].tau_G);
    const PointBranch& b = state.branches[k];
    after.push_back(
        {physics::relaxed(w_C, b.A, inverse_C(at(w_C.theta[0])), inverse_C(at(w_C.theta[1]))),
         physics::relaxed(w_G, b.S, inverse_G(at(w_G.theta[0])), inverse_G(at(w_G.theta[1])))});
  }
  return after;
}

}  // namespace diptych::run
