#include "common/run/material_point.hpp"

#include "common/base/registry.hpp"
#include "common/physics/materials/isochoric_neo_hookean.hpp"
#include "common/physics/materials/mooney_rivlin.hpp"
#include "common/physics/moduli.hpp"
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

template <class Material>
class PointOf : public MaterialPoint {
 public:
  PointOf(const Material& material, const cases::MaterialCase& setup)
      : MaterialPoint(branches_of(setup, material.branch_xi(), material.branch_zeta())),
        material_(material) {}

  Mat3 stress(const PointState& state) const override {
    const auto X = deformation(state.F);
    return algebra::to_eigen(physics::piola_stress<Material::has_H>(response(state, X), X));
  }
  double energy(const PointState& state) const override {
    const auto X = deformation(state.F);
    double W = material_.energy(X);
    for (size_t k = 0; k < branches().size(); ++k)
      W += physics::branch_energy<Material::has_H>(branches()[k], state.branches[k], X);
    return W;
  }
  double dissipation(const PointState& state) const override {
    const auto X = deformation(state.F);
    double D = 0;
    for (size_t k = 0; k < branches().size(); ++k)
      D += physics::branch_dissipation<Material::has_H>(branches()[k], state.branches[k],
                                                        physics::right_tensors(X.F));
    return D;
  }
  Mat3 acoustic_tensor(const PointState& state, const Vec3& N) const override {
    const auto X = deformation(state.F);
    return algebra::to_eigen(physics::acoustic_tensor(response(state, X), X, {{N[0], N[1], N[2]}}));
  }

 private:
  physics::Response<double> response(const PointState& state,
                                     const physics::Deformation<double>& X) const {
    auto r = material_.response(X);
    for (size_t k = 0; k < branches().size(); ++k)
      physics::add_branch_response<Material::has_H>(branches()[k], state.branches[k], X, r);
    return r;
  }
  Material material_;
};

std::unique_ptr<MaterialPoint> make_mooney_rivlin_point(const cases::MaterialCase& m) {
  const auto p = physics::mooney_rivlin_parameters({m.shear_modulus, m.lame}, m.zeta_ratio);
  const physics::MooneyRivlin material{p.xi, p.zeta, p.lambda_hat};
  return std::make_unique<PointOf<physics::MooneyRivlin>>(material, m);
}
std::unique_ptr<MaterialPoint> make_neo_hookean_point(const cases::MaterialCase& m) {
  const auto p = physics::mooney_rivlin_parameters({m.shear_modulus, m.lame}, 0);
  const physics::NeoHookean material{p.xi, 0, p.lambda_hat};
  return std::make_unique<PointOf<physics::NeoHookean>>(material, m);
}
template <class Material>
std::unique_ptr<MaterialPoint> make_isochoric_point(const cases::MaterialCase& m) {
  const Material material{m.shear_modulus, m.lame + 2 * m.shear_modulus / 3};
  return std::make_unique<PointOf<Material>>(material, m);
}

}  // namespace

std::unique_ptr<MaterialPoint> make_material_point(const cases::MaterialCase& material) {
  using Maker = std::unique_ptr<MaterialPoint> (*)(const cases::MaterialCase&);
  const auto menu =
      base::Registry<Maker>("material.model")
          .add("mooney-rivlin", make_mooney_rivlin_point)
          .add("neo-hookean", make_neo_hookean_point)
          .add("neo-hookean-isochoric", make_isochoric_point<physics::IsochoricNeoHookean>)
          .add("neo-hookean-isochoric-j2", make_isochoric_point<physics::IsochoricNeoHookeanJ2>);
  return menu.at(material.model)(material);
}

PointState MaterialPoint::virgin(const Mat3& F) const {
  const auto I = algebra::symmetric_identity<double>();
  return {F, std::vector<PointBranch>(branches_.size(), PointBranch{I, I})};
}

std::vector<PointBranch> MaterialPoint::branch_rates(const PointState& state) const {
  const auto X = deformation(state.F);
  std::vector<PointBranch> rates;
  for (size_t k = 0; k < branches_.size(); ++k) {
    const PointBranch& b = state.branches[k];
    rates.push_back({(1 / branches_[k].tau_C) * (inverse_C(X) + (-1.0) * b.A),
                     (1 / branches_[k].tau_G) * (inverse_G(X) + (-1.0) * b.S)});
  }
  return rates;
}

std::vector<PointBranch> MaterialPoint::relaxed_linear(const PointState& state,
                                                       const Mat3& F_end,
                                                       double dt) const {
  const auto X = deformation(state.F), Y = deformation(F_end);
  std::vector<PointBranch> after;
  for (size_t k = 0; k < branches_.size(); ++k) {
    const auto w_C = physics::linear_relaxation(dt / branches_[k].tau_C);
    const auto w_G = physics::linear_relaxation(dt / branches_[k].tau_G);
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
  for (size_t k = 0; k < branches_.size(); ++k) {
    const auto w_C = physics::gauss_relaxation(dt / branches_[k].tau_C);
    const auto w_G = physics::gauss_relaxation(dt / branches_[k].tau_G);
    const PointBranch& b = state.branches[k];
    after.push_back(
        {physics::relaxed(w_C, b.A, inverse_C(at(w_C.theta[0])), inverse_C(at(w_C.theta[1]))),
         physics::relaxed(w_G, b.S, inverse_G(at(w_G.theta[0])), inverse_G(at(w_G.theta[1])))});
  }
  return after;
}

}  // namespace diptych::run
