#pragma once
/// Host-side vectors and matrices (set-up, interfaces, tests): double precision Eigen. Hot code
/// uses common/algebra/tensor.hpp instead.

#include <Eigen/Dense>

namespace diptych::algebra {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace diptych::algebra
