#pragma once
/// Angular-momentum projection (notes 3.7): the smallest change of the velocities, in the
/// mass-weighted norm, that gives a free body a wanted angular momentum and keeps its linear
/// momentum: v_a += lambda x (x_a - x_c), x_c the centre of mass, lambda = K^-1 (wanted - L).

#include "common/scheme/body/body.hpp"

namespace diptych::scheme {

/// @param wanted  N m s, about the initial centroid
/// @return        change of the kinetic energy  [J]
template <int Dim>
double project_angular_momentum(Body<Dim>& body, const Vec3& wanted);

}  // namespace diptych::scheme
