#pragma once
/// The largest rates of the linearised, undeformed body, per unit of c_p: what limits the time
/// step. The operators are those of the run itself, by its own sweeps on its own fields: the strain
/// rates (18b) with the face correction, a linear stress, the forces (18a), and D_ab of plain jumps
/// with z_p = rho_R c_p. Lanczos iterations from a fixed vector come within a percent or two of the
/// largest eigenvalue, from below. Reconstruction is left out, but for the symmetric one: the
/// roughest modes have hardly a gradient. Test: tests/common/run/default_cfl_test.cpp

#include "common/algebra/four.hpp"
#include "common/run/lanczos.hpp"
#include "common/scheme/body/body.hpp"
#include "common/scheme/sweeps/face_correction.hpp"
#include "common/scheme/sweeps/momentum.hpp"

namespace diptych::run {

/// Of the undeformed material with its branches at once.
struct ElasticRatios {
  double shear = 1;  ///< c_s/c_p
  double cells = 0;  ///< part of rho_R c_p^2 that volumes of cells carry, where the body has them
  double cell_shear = 0;  ///< and that of their gradients
  double hourglass = 0;   ///< and that of scheme/hourglass
};

template <int Dim>
class LargestRates {
 public:
  /// @param body   at rest; its velocities, records (but for H) and forces are lost
  /// @param moves  [n_nodes] 0 for nodes that are held, 1 for the others; empty: none is held
  LargestRates(scheme::Body<Dim>& body, double kappa_f, std::vector<double> moves = {});

  /// d of plain jumps, or symmetric ones where the body has their moments, with
  /// scheme.dissipation = 1, per unit of c_p  [1/m]
  double dissipation(double shear_ratio);

  /// The largest d of the states in which the cofactor of F turns all deformed areas towards one
  /// direction of the axes, as a strong compression along it does: D_ab then acts along it with z_p
  /// over all pairs that are not square to it. On lattices of edges the same as at rest.  [1/m]
  double dissipation_turned(double shear_ratio);

  /// omega of u -> G* (lambda tr(e) I + 2 mu e) with e the symmetric part of G u, G the gradient of
  /// (18b) and G* its adjoint; what cells carry of lambda acts on their volumes. On a lattice the
  /// fastest is a pressure wave, at free boundaries up to sqrt(2) times as fast as inside, where
  /// lambda >> mu another half: the divergence may count for more there than waves along one
  /// direction do.  [1/m]
  double frequency(const ElasticRatios& ratios);

  /// Largest eigenvalue of dt^2/4 K + dt/2 D, K the elastic operator and D the dissipation:
  /// leapfrog is stable where it is below one. Alone dt omega and dt d say so only if the fastest
  /// and the most damped modes differ; at the corners of operators that sum by parts they do not.
  /// @param dt  c_p times the step  [m]  @param strength  of the dissipation
  double leapfrog_limit(double dt, const ElasticRatios& ratios, double strength);

 private:
  using Vectors = lanczos::Field<algebra::Four>;
  void put_velocities(const Vectors& v);
  /// Impedances of the dissipation; no stresses.
  void put_impedances(double shear_ratio);
  /// H of all nodes: the identity, but for this part of it across an axis; none: all of it.
  void put_cofactors(int axis, double across);
  /// out <- -T / Omega for the stresses and impedances in the records.
  void divide_forces(Vectors& out) const;
  /// out <- (K + strength D) u in one sweep.
  void apply(const Vectors& u, const ElasticRatios& ratios, double strength, Vectors& out);
  void put_stresses(const ElasticRatios& ratios);
  void clear_stresses();
  void sum_forces(double dissipation_factor);

  scheme::Body<Dim>& body_;
  double kappa_f_;
  std::vector<double> moves_;
  scheme::MomentumFunction<Dim> momentum_;
  scheme::FaceCorrectionSweeps<Dim> face_;
  std::vector<double> scratch_;  ///< results per chunk that nobody needs
};

extern template class LargestRates<2>;
extern template class LargestRates<3>;

}  // namespace diptych::run
