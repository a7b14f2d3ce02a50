#pragma once
/// What energies and momenta of a body are measured with.
/// Test: tests/common/run/guards_test.cpp

#include "common/algebra/vectors.hpp"
#include "common/cases/case.hpp"
#include "common/scheme/budget/audit.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <algorithm>

namespace diptych::run {

/// The frame of the centre of mass, along directions in which nothing that stands still holds the
/// body. What it carries there hangs on who looks, a falling body or a support that moves on takes
/// it along, and it is no measure of what the body holds. Of the work of loads and supports the
/// frame's is what that energy has changed by (Koenig's theorem).
struct CentreFrame {
  algebra::Mat3 free = algebra::Mat3::Zero();  ///< projector on those directions
  double mass = 0;                             ///< kg
  /// J, kinetic energy of the centre of mass along them
  double carried(const scheme::Balance& balance) const {
    return mass > 0 ? 0.5 * (free * balance.linear_momentum).squaredNorm() / mass : 0;
  }
};

struct EnergyUnits {
  /// J, what rounding makes of the energies of a body in place: 100 eps of rho c_p^2 a volume, that
  /// of a strain of 2e-7 (with F alone 1 eps and 2e-8; in single precision 10 eps of it
  /// and 1.5e-3). A body that has held no more is at rest.
  double in_place = 0;
  CentreFrame frame{};
  double of_carried = 0;  ///< the same as a share of what the frame carries

  double rounding(double carried) const { return std::max(in_place, of_carried * carried); }
};

/// @param speed  of pressure waves of the undeformed body, m/s
EnergyUnits energy_units(const cases::Case& setup, const scheme::PairGraph& graph, double speed);

/// Of a body all of which moves with the energy that rounding makes: less has no drift.
struct MomentumUnits {
  double linear = 0;   ///< N s
  double angular = 0;  ///< N m s, as far from the centroid as the farthest node
};

MomentumUnits momentum_units(const cases::Case& setup,
                             const scheme::PairGraph& graph,
                             double energy);

/// Polar moment of inertia about the centroid of a body that supports hold (components of
/// velocities are prescribed): one that turns with the energy E has an angular momentum of sqrt(2 I
/// E), and no motion with that energy has more. [kg m^2] 0 of one that they do not.
double inertia_if_held(const cases::Case& setup, const scheme::PairGraph& graph);

}  // namespace diptych::run
