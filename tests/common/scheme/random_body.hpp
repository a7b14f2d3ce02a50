#pragma once
/// A random state on a graph of either method for the tests of the pair sweeps, with what they
/// compare.

#include "common/parallel/for_chunks.hpp"
#include "common/physics/materials/mooney_rivlin.hpp"
#include "common/scheme/sweeps/compiled/momentum.hpp"
#include "common/scheme/sweeps/compiled/strain_rates.hpp"
#include "common/scheme/sweeps/compiled_material.hpp"
#include "common/scheme/sweeps/frames.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

extern template class diptych::scheme::CompiledMaterial<diptych::physics::MooneyRivlin>;

namespace diptych::tests {

using algebra::Vec3;
using scheme::Arrangement;
using scheme::DissipationKind;
using Material = physics::MooneyRivlin;

using StrainRates = scheme::StrainRateVersions<3>;
using StrainRateFunction = StrainRates::Function;

/// A random finite deformation and velocity on a graph, evaluated once.
class RandomBody {
 public:
  RandomBody(const std::string& method,
             DissipationKind kind,
             Arrangement arrangement = Arrangement::runs,
             bool affine = false,
             const std::array<int, 3>& cells = {5, 4, 3},
             scheme::Precision precision = scheme::Precision::full)
      : graph_(graph_of(
            method, meshes::box(meshes::CellType::hexahedron, Vec3::Zero(), Vec3::Ones(), cells))),
        rounded_((set_precision(graph_, precision), true)),
        material({{1.3e6, 0.7e6, 4e6}, 1100, {{0.9e6, 2e-3, 0.4e6, 1e-3}}}),
        kind_(kind),
        state(graph_, options_of(kind), arrangement),
        chunks_(static_cast<size_t>(parallel::n_chunks_of(state.n_blocks))) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::Matrix3d G;
    for (int k = 0; k < 9; ++k)
      G(k / 3, k % 3) = 40 * uniform(random);
    const auto place = [&](algebra::BlockField& field, std::int64_t a, int first,
                           const Eigen::Matrix3d& M) {
      constexpr int order[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
      for (int k = 0; k < 6; ++k)
        field.set(a, first + k, M(order[k][0], order[k][1]));
    };
    for (std::int64_t a = 0; a < state.n_blocks * algebra::n_lanes; ++a) {
      Eigen::Matrix3d R;
      for (int k = 0; k < 9; ++k)
        R(k / 3, k % 3) = uniform(random);
      for (int k = 0; k < 9; ++k)
        state.F.set(a, k, 0.2 * R(k / 3, k % 3));
      place(state.A, a, 0, 0.1 * (R + R.transpose()));
      place(state.S, a, 0, -0.1 * (R + R.transpose()));
      for (int i = 0; i < 3; ++i) {
        double v = uniform(random);
        if (affine && a < graph_.n_nodes()) v = G.row(i).dot(graph_.X[a]);
        state.v.set(a, i, v);
      }
    }
  }

  /// Evaluates strain rates and forces with one instruction set.
  void evaluate(StrainRateFunction strain_rates,
                scheme::MomentumFunction<3> momentum,
                double factor = 1) {
    const scheme::Relaxation frozen;
    const scheme::StrainRateSweep<3> first{state,   material, frozen,         0,
                                           nullptr, 0,        viscous.data(), least_J.data()};
    parallel::for_chunks(state.n_blocks,
                         [&](auto b, auto e, auto c) { strain_rates(first, b, e, c); });
    if (state.options.has_frames) scheme::set_frames(state, 0, state.n_blocks);
    const scheme::MomentumSweep<3> sweep{state,       factor,        true, numerical.data(),
                                         rate.data(), limited.data()};
    if (state.options.has_moments) {
      scheme::sum_moments(sweep, scheme::moments_function<3>(kind_.impedance, true));
      scheme::take_moments(state);
    }
    scheme::sum_forces(sweep, momentum);
  }
  /// Both in one pass, or in two, of a body that drifts by dt, which takes the power of the forces
  /// before. @pre runs, no frames or moments
  void evaluate_drifting(double dt, bool in_one_pass) {
    const scheme::Relaxation frozen;
    const scheme::StrainRateSweep<3> rates{
        state, material, frozen, 0, nullptr, dt, viscous.data(), least_J.data(), old_power.data()};
    if (!in_one_pass) {
      scheme::evaluate_strain_rates(rates);
      scheme::sum_forces<3>({state, 1, true, numerical.data(), rate.data(), limited.data()},
                            scheme::momentum_function<3>(kind_, true));
      return;
    }
    const auto make_records = scheme::strain_rate_function<3>();
    scheme::sum_forces_of_stage(
        {state, 1, true, numerical.data(), rate.data(), limited.data()},
        scheme::momentum_function<3>(kind_, true),
        [&](auto begin, auto end, auto chunk) { make_records(rates, begin, end, chunk); });
  }
  void evaluate(double factor = 1) {
    evaluate(algebra::version_here<StrainRates>(), scheme::momentum_function<3>(kind_, true),
             factor);
  }

  static scheme::BodyOptions options_of(const DissipationKind& kind) {
    scheme::BodyOptions options;
    options.rho_R = 1100;
    options.n_branches = 1;
    options.has_G = true;
    options.unknowns = scheme::Unknowns::F;
    options.exact_impedance = kind.impedance == scheme::Impedance::exact;
    options.has_frames = kind.reconstruction == scheme::Reconstruction::objective;
    options.has_moments = kind.reconstruction == scheme::Reconstruction::symmetric;
    return options;
  }
  const scheme::PairGraph& graph() const { return graph_; }
  double numerical_power() const { return parallel::sum_in_order(numerical); }
  double limited_pairs() const { return parallel::sum_in_order(limited); }
  Vec3 vector(const algebra::NodeTable& field, std::int64_t a) const {
    return {field.at(a, 0), field.at(a, 1), field.at(a, 2)};
  }
  /// sum Omega P : L, with P as the sweep left it for the neighbours, and what it took from it
  double stress_power() const {
    double power = 0;
    for (std::int64_t a = 0; a < graph_.n_nodes(); ++a) {
      for (int k = 0; k < 9; ++k) {
        const double N = state.options.has_moments ? state.moments.at(a, k) : 0;
        power += graph_.Omega[a] * state.records.at(a, scheme::NodeRecord<3>::L + k) *
                 (state.records.at(a, scheme::NodeRecord<3>::P + k) + N);
      }
    }
    return power;
  }

 private:
  scheme::PairGraph graph_;
  bool rounded_;

 public:
  scheme::CompiledMaterial<Material> material;

 private:
  DissipationKind kind_;

 public:
  scheme::Body<3> state;

 private:
  size_t chunks_;

 public:
  std::vector<double> viscous = std::vector<double>(chunks_), least_J = viscous,
                      numerical = viscous, rate = viscous, limited = viscous, old_power = viscous;
};

inline constexpr DissipationKind isotropic{};
inline constexpr DissipationKind exact{scheme::Reconstruction::linear, scheme::PairLimiter::none,
                                       scheme::Impedance::exact};
inline constexpr DissipationKind limited{scheme::Reconstruction::linear,
                                         scheme::PairLimiter::sign_preserving,
                                         scheme::Impedance::isotropic};
inline constexpr DissipationKind barth_jespersen{scheme::Reconstruction::linear,
                                                 scheme::PairLimiter::barth_jespersen,
                                                 scheme::Impedance::isotropic};
inline constexpr DissipationKind venkatakrishnan{scheme::Reconstruction::linear,
                                                 scheme::PairLimiter::venkatakrishnan,
                                                 scheme::Impedance::isotropic};
inline constexpr DissipationKind limited_exact{
    scheme::Reconstruction::linear, scheme::PairLimiter::sign_preserving, scheme::Impedance::exact};
inline constexpr DissipationKind plain{scheme::Reconstruction::none, scheme::PairLimiter::none,
                                       scheme::Impedance::isotropic};

inline constexpr DissipationKind objective{scheme::Reconstruction::objective,
                                           scheme::PairLimiter::none, scheme::Impedance::isotropic};
inline constexpr DissipationKind limited_objective{scheme::Reconstruction::objective,
                                                   scheme::PairLimiter::sign_preserving,
                                                   scheme::Impedance::isotropic};

inline constexpr DissipationKind symmetric{scheme::Reconstruction::symmetric,
                                           scheme::PairLimiter::none, scheme::Impedance::isotropic};
inline constexpr DissipationKind symmetric_exact{
    scheme::Reconstruction::symmetric, scheme::PairLimiter::none, scheme::Impedance::exact};

// 400 random nodes with entries of order one: sums of about 1e4 products, rounding about 1e-14.
inline constexpr double rounding = 1e-12;

/// Forces and velocity gradients of all nodes.
inline std::vector<double> results(const RandomBody& body) {
  std::vector<double> all;
  for (std::int64_t a = 0; a < body.graph().n_nodes(); ++a) {
    for (int i = 0; i < 3; ++i)
      all.push_back(body.state.T.at(a, i));
    for (int k = 0; k < 9; ++k)
      all.push_back(body.state.records.at(a, scheme::NodeRecord<3>::L + k));
  }
  return all;
}

inline double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  return most;
}

/// Relative sum of the forces, and relative difference of their power from that of the stresses and
/// the dissipation.
inline std::array<double, 2> identity_errors(const RandomBody& body) {
  Vec3 sum = Vec3::Zero();
  double scale = 0, power = 0;
  for (std::int64_t a = 0; a < body.graph().n_nodes(); ++a) {
    const Vec3 force = body.vector(body.state.T, a);
    sum += force;
    scale += force.norm();
    power += body.vector(body.state.v, a).dot(force);
  }
  const double stress_power = body.stress_power(), numerical = body.numerical_power();
  return {sum.norm() / scale, std::abs(power + stress_power + numerical) /
                                  (std::abs(stress_power) + std::abs(numerical))};
}

}  // namespace diptych::tests
