#pragma once
/// What energies and momenta of a body are measured with.
/// Test: tests/common/run/guards_test.cpp

#include "common/cases/case.hpp"
#include "common/scheme/budget/audit.hpp"
#include "common/scheme/graph/pair_graph.hpp"

namespace diptych::run {

struct EnergyUnits {
  /// J, what rounding makes of the energies of a body: 100 eps of rho c_p^2 a volume, that of a
  /// strain of 2e-7 (with F alone 1 eps and 2e-8), and of `carried` where that is more. A body that
  /// has held no more is at rest.
  double rounding = 0;
  /// J, kinetic energy of the centre of mass that a body without supports begins with: as much as
  /// the frame in which it is described gives it, and so no measure of what it holds.
  double carried = 0;
};

/// What is known of them before the state is.
struct EnergyBasis {
  double rounding = 0;   ///< J, of a body in place
  double free_mass = 0;  ///< kg, of a body without supports; of others 0
  double eps = 0;        ///< what a step rounds the state by
  EnergyUnits at(const scheme::Balance& initial) const;
};

/// @param speed  of pressure waves of the undeformed body, m/s
EnergyBasis energy_basis(const cases::Case& setup, const scheme::PairGraph& graph, double speed);

/// Of a body all of which moves with the energy of EnergyUnits::rounding: less has no drift.
struct MomentumUnits {
  double linear = 0;   ///< N s
  double angular = 0;  ///< N m s, as far from the centroid as the farthest node
};

MomentumUnits momentum_units(const cases::Case& setup,
                             const scheme::PairGraph& graph,
                             const EnergyUnits& energies);

/// Polar moment of inertia about the centroid of a body that supports hold (components of
/// velocities are prescribed): one that turns with the energy E has an angular momentum of sqrt(2 I
/// E), and no motion with that energy has more. [kg m^2] 0 of one that they do not.
double inertia_if_held(const cases::Case& setup, const scheme::PairGraph& graph);

}  // namespace diptych::run
