#pragma once
/// What is told of the stress at a node: Cauchy stress, pressure, von Mises stress. Plane strain
/// keeps its stress out of the plane, so all three are those of the body in space. Probes, frames
/// and reports use these alone. Test: tests/common/cases/stress_measures_test.cpp

#include "common/algebra/vectors.hpp"

#include <cmath>

namespace diptych::cases {

/// sigma = P F^T / J  [Pa]
/// @param P, F, J  first Piola-Kirchhoff stress [Pa], deformation gradient [-], Jacobian > 0 [-]
inline algebra::Mat3 cauchy_stress(const algebra::Mat3& P, const algebra::Mat3& F, double J) {
  return P * F.transpose() / J;
}

/// p = -1/3 tr sigma  [Pa]
inline double pressure(const algebra::Mat3& sigma) {
  return -sigma.trace() / 3;
}

/// sqrt(3/2 s:s), s = sigma + p I the deviator  [Pa]
inline double von_mises(const algebra::Mat3& sigma) {
  const algebra::Mat3 deviator = sigma + pressure(sigma) * algebra::Mat3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

}  // namespace diptych::cases
