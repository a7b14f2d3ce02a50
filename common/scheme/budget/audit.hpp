#pragma once
/// The audit: integrals over time of what enters and leaves a body, evolved with the same scheme
/// and the same weights as the state (notes 6), so that their residuals converge at its
/// order:
///   K + W - (K + W)_0 = external work + projection work
///                       - numerical dissipation - viscous dissipation.

#include "common/algebra/vectors.hpp"

#include <algorithm>

namespace diptych::scheme {

using algebra::Vec3;

/// Linear impulse [N s] and its moment about the initial centroid [N m s].
struct Impulse {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
  Impulse& operator+=(const Impulse& other) {
    linear += other.linear;
    angular += other.angular;
    return *this;
  }
};

/// What constraints did to a state when they were applied.
struct ConstraintAction {
  Impulse impulse;
  double work = 0;    ///< J, what prescribed velocities brought, less what impacts took
  double caught = 0;  ///< J, of kinetic energy: what impacts took
  ConstraintAction& operator+=(const ConstraintAction& other) {
    impulse += other.impulse;
    work += other.work;
    caught += other.caught;
    return *this;
  }
};

/// Rates of the loads at one instant.
struct LoadRates {
  double power = 0;            ///< W
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 torque = Vec3::Zero();  ///< N m
  LoadRates& operator+=(const LoadRates& other) {
    power += other.power;
    force += other.force;
    torque += other.torque;
    return *this;
  }
};

/// Integrals, or, with the same members, their rates.
struct Audit {
  double external_work = 0;          ///< J
  double numerical_dissipation = 0;  ///< J
  double viscous_dissipation = 0;    ///< J
  double contact_loss = 0;  ///< J, of external_work: what walls took of nodes as they caught them
  double projection_work = 0;  ///< J, kinetic energy that the projection of notes 3.7 gave
  Impulse impulse;             ///< of loads and constraints

  /// What the energy of the body has grown by, were the budget exact  [J]
  double gain() const {
    return external_work + projection_work - numerical_dissipation - viscous_dissipation;
  }

  /// alpha old + beta (this + dt rate) of what has a rate at an instant; the viscous dissipation
  /// and the projection are added by whole steps.
  Audit combined(double alpha, const Audit& old, double beta, double dt, const Audit& rate) const {
    const auto mix = [&](const auto& now, const auto& before, const auto& slope) {
      return alpha * before + beta * (now + dt * slope);
    };
    Audit r = *this;
    r.external_work = mix(external_work, old.external_work, rate.external_work);
    r.numerical_dissipation =
        mix(numerical_dissipation, old.numerical_dissipation, rate.numerical_dissipation);
    r.impulse.linear = mix(impulse.linear, old.impulse.linear, rate.impulse.linear);
    r.impulse.angular = mix(impulse.angular, old.impulse.angular, rate.impulse.angular);
    return r;
  }
};

/// Energies and momenta of a state.
struct Balance {
  double kinetic = 0;                    ///< J
  double strain = 0;                     ///< J, equilibrium and branches
  Vec3 linear_momentum = Vec3::Zero();   ///< N s
  Vec3 angular_momentum = Vec3::Zero();  ///< N m s, about the initial centroid
  double momentum_scale = 0;             ///< N s, sum of |p|
  double angular_scale = 0;              ///< N m s, sum of |x||p|
  double least_J = 1;
  double involution_H = 0;  ///< max |H - cof F|
  double involution_J = 0;  ///< max |J - det F|
  /// m^Dim, of the volumes that carry the pressure (notes 3.9, 3.10), and the sum of |J of the
  /// nodes times their volume at rest - that volume|; zero where nodes carry it
  double carried_volume = 0, volume_apart = 0;
  double swing = 0;  ///< J, what leapfrog's energy is off by and comes back from (notes 5.6)

  /// How far both volumes are apart, as a share of the body's.
  double volumes_apart() const {
    return volume_apart == 0 ? 0 : volume_apart / std::max(carried_volume, 0.0);
  }
};

}  // namespace diptych::scheme
