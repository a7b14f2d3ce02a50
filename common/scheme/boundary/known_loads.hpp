#pragma once
/// Body force and stress at every node where the motion is known beforehand (manufactured
/// solutions): what the momentum equation and tractions need to follow it.

#include "common/algebra/field.hpp"
#include "common/algebra/vectors.hpp"

#include <cstdint>

namespace diptych::scheme {

class KnownLoads {
 public:
  virtual ~KnownLoads() = default;
  /// Moves to time t; the values below are of that time.
  virtual void move_to(double t) = 0;
  /// f = rho_R a - DIV P  [N/m^3], as many components as the body has dimensions
  virtual const algebra::BlockField& body_forces() const = 0;
  /// First Piola-Kirchhoff stress of a node [Pa]
  virtual algebra::Mat3 stress(std::int64_t node) const = 0;
};

}  // namespace diptych::scheme
