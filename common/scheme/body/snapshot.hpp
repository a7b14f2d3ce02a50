#pragma once
/// The fields of a body as numbers of the host: what observers, errors and reports read.

#include "common/algebra/vectors.hpp"

#include <vector>

namespace diptych::scheme {

using algebra::Mat3;
using algebra::Vec3;

/// Nodal fields in the numbering of the graph.
struct Snapshot {
  double time = 0;
  std::vector<Vec3> u, v;               ///< m, m/s
  std::vector<Mat3> F, H, P;            ///< -, -, Pa
  std::vector<double> J;                ///< -
  std::vector<std::vector<Mat3>> A, S;  ///< [branch][node] C_v^-1, G_v^-1
};

}  // namespace diptych::scheme
