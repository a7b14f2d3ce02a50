#pragma once
/// Angular-momentum projection (notes 3.7): the smallest change of the velocities, in the
/// mass-weighted norm, that gives a body a wanted angular momentum and keeps its linear momentum:
/// v_a += lambda x (x_a - x_c), x_c the centre of mass, lambda = K^-1 (wanted - L).

#include "common/scheme/body/body.hpp"

namespace diptych::scheme {

/// What was done to the velocities: v_a += spin x (x_a - centre).
struct Projection {
  Vec3 spin;        ///< 1/s, lambda
  Vec3 centre;      ///< m, from the initial centroid
  double gain = 0;  ///< J, change of the kinetic energy
};

/// @param wanted  N m s, about the initial centroid
template <int Dim>
Projection project_angular_momentum(Body<Dim>& body, const Vec3& wanted);

}  // namespace diptych::scheme
