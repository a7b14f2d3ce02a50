#pragma once
/// The largest rates of the linearised, undeformed body, per unit of c_p: what limits the time
/// step. The dissipation is the operator
///   v_a -> 1/(2 Omega_a) sum_b |S_ab| (N(x)N + c_s/c_p (I - N(x)N)) (v_a - v_b),
/// the square of the frequency that of u -> G* G u, for one component u, G the gradient of (18b)
/// with its face correction and G* its adjoint (the force of (18a)). On a lattice that is a
/// pressure wave; free boundaries count, where it is up to sqrt(2) times as fast as inside.
///
/// Both are symmetric in the inner product with the weights Omega_a. Lanczos iterations from a
/// fixed vector come within a percent or two of the largest eigenvalue, from below; every sum has a
/// fixed order. Reconstruction is left out: the roughest modes have hardly a gradient. Test:
/// tests/common/run/default_cfl_test.cpp

#include "common/scheme/graph/pair_graph.hpp"

namespace diptych::run {

class LargestRates {
 public:
  /// @param graph  must outlive this
  explicit LargestRates(const scheme::PairGraph& graph);

  /// d of plain jumps with scheme.dissipation = 1, per unit of c_p  [1/m]
  double dissipation(double shear_ratio) const;

  /// omega per unit of c_p  [1/m]
  double frequency(double kappa_f) const;

  /// The same of all components together, u -> G* (lambda tr(e) I + 2 mu e) with e the symmetric
  /// part of G u. Inside a lattice it is no larger; near boundaries, where lambda >> mu, it can be
  /// by a half, since the divergence may count for more than waves along one direction do.
  /// @param shear_ratio  c_s/c_p, <= sqrt(3)/2
  double elastic_frequency(double kappa_f, double shear_ratio) const;

  /// Largest eigenvalue of dt^2/4 K + dt/2 D, K the elastic operator and D the dissipation:
  /// leapfrog is stable where it is below one. Alone dt omega and dt d say so only if the fastest
  /// and the most damped modes differ; at the corners of operators that sum by parts they do not.
  /// @param dt  c_p times the step  [m]  @param strength  of the dissipation
  double leapfrog_limit(double dt, double kappa_f, double shear_ratio, double strength) const;

 private:
  class Gradient;
  class Elasticity;
  class Dissipation;

  /// Calls set(kind, i, k) for the pairs k of one node of each kind, i counting them all.
  template <class Set>
  void for_geometry(const Set& set) const;

  /// Whether nodes share pairs; else every node is of a kind of its own.
  bool shared() const;
  /// Of the pairs of the kinds; b - a where they are shared.
  const std::int32_t* neighbours() const;

  const scheme::PairGraph& graph_;
  /// Of nodes with the same C_ab and C_ba up to rounding and neighbours as far in the numbering.
  scheme::EqualGroups kinds_;
  std::vector<std::int64_t> first_;   ///< [kinds + 1] into their pairs
  std::vector<std::int32_t> offset_;  ///< b - a of shared pairs
};

}  // namespace diptych::run
