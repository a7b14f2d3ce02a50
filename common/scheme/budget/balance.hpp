#pragma once
/// Energies, momenta and involution drifts of a state (notes 6).

#include "common/parallel/for_chunks.hpp"
#include "common/scheme/body/pointwise.hpp"
#include "common/scheme/budget/audit.hpp"
#include "common/scheme/graph/sweep_graph.hpp"

namespace diptych::scheme {

/// Sums over blocks [begin, end).
template <int Dim, class Material>
DIPTYCH_CLONES void add_energies(const Model<Material>& model,
                                 const SweepGraph<Dim>& graph,
                                 const State<Dim>& state,
                                 std::int64_t begin,
                                 std::int64_t end,
                                 Balance& sum) {
  const Relaxation frozen;
  double least_J = sum.least_J;
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes Omega = algebra::load(graph.Omega.data() + b * n_lanes);
    const Deformation<Lanes> X = load_deformation(state, b);
    Lanes W = model.material.energy(X);
    response_of_block(model, state, frozen, X, b,
                      [&](int k, const BranchState<Lanes>& branch, const auto&) {
                        W += physics::branch_energy<Material::has_H>(model.branches[k], branch, X);
                      });
    Lanes v_v{};
    for (int i = 0; i < Dim; ++i)
      v_v += state.v.get(b, i) * state.v.get(b, i);
    sum.kinetic += 0.5 * model.rho_R * algebra::lane_sum(Omega * v_v);
    sum.strain += algebra::lane_sum(Omega * W);
    const Deformation<Lanes> exact = physics::deformation_of(X.F);
    for (int l = 0; l < n_lanes; ++l) {
      least_J = algebra::smaller(least_J, X.J[l]);
      sum.involution_J = algebra::larger(sum.involution_J, std::fabs(X.J[l] - exact.J[l]));
      for (int k = 0; k < 9; ++k) {
        const double drift = std::fabs(X.H(k / 3, k % 3)[l] - exact.H(k / 3, k % 3)[l]);
        sum.involution_H = algebra::larger(sum.involution_H, drift);
      }
    }
  }
  sum.least_J = least_J;
}

/// @param X_centred  [n_nodes] m, reference positions about the centroid
template <int Dim>
void add_momenta(const SweepGraph<Dim>& graph,
                 const State<Dim>& state,
                 const std::vector<Vec3>& X_centred,
                 double rho_R,
                 std::int64_t begin,
                 std::int64_t end,
                 Balance& sum) {
  for (std::int64_t a = begin * n_lanes; a < std::min(end * n_lanes, graph.n_nodes); ++a) {
    Vec3 p = Vec3::Zero(), x = X_centred[a];
    for (int i = 0; i < Dim; ++i) {
      p[i] = rho_R * graph.Omega[a] * state.v.at(a, i);
      x[i] += state.u.at(a, i);
    }
    sum.linear_momentum += p;
    sum.angular_momentum += x.cross(p);
    sum.momentum_scale += p.norm();
    sum.angular_scale += x.norm() * p.norm();
  }
}

template <int Dim, class Material>
Balance balance(const Model<Material>& model,
                const SweepGraph<Dim>& graph,
                const State<Dim>& state,
                const std::vector<Vec3>& X_centred) {
  std::vector<Balance> parts(parallel::n_chunks_of(graph.n_blocks));
  parallel::for_chunks(graph.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t c) {
    parts[c].least_J = 1e300;
    add_energies(model, graph, state, begin, end, parts[c]);
    add_momenta(graph, state, X_centred, model.rho_R, begin, end, parts[c]);
  });
  Balance sum;
  sum.least_J = 1e300;
  for (const Balance& part : parts) {
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.linear_momentum += part.linear_momentum;
    sum.angular_momentum += part.angular_momentum;
    sum.momentum_scale += part.momentum_scale;
    sum.angular_scale += part.angular_scale;
    sum.least_J = std::min(sum.least_J, part.least_J);
    sum.involution_H = std::max(sum.involution_H, part.involution_H);
    sum.involution_J = std::max(sum.involution_J, part.involution_J);
  }
  return sum;
}

}  // namespace diptych::scheme
