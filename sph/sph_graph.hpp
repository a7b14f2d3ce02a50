#pragma once
/// Total Lagrangian SPH as a pair graph: paper (19) with linear gradient correction and the
/// exact boundary closure of notes 3.3, by the least change of the C_ab.

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::sph {

struct Options {
  std::string kernel = "cubic-spline";  ///< cubic-spline, quintic-spline, wendland-c2
  double kappa = 1.2;                   ///< h_a = kappa (Omega_a / filled part of the angle)^(1/d)
  bool closure = true;                  ///< repair the closure
  std::string gradient = "corrected";   ///< corrected, sbp or auto: sbp where it is sure to do
};

/// What Options::gradient may be.
const std::vector<std::string>& gradient_names();

/// Pairs are those with |X_b - X_a| < support (h_a + h_b)/2, W_ab = W(|X_b - X_a|, (h_a + h_b)/2):
/// symmetric. Particles see each other across gaps and cracks narrower than that.
/// @throws base::InputError on an unknown kernel, kappa out of range, a particle with too
/// few
///         (non-coplanar) neighbours: names it and its place
scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options);

/// What build_graph makes of a mesh, where that depends on more than the options.
struct Operators {
  std::string text;                  ///< for the record; empty where corrected was asked for
  std::vector<std::string> notices;  ///< where it promises less
  /// "auto" took the corrected gradient because of the nodes alone: "sbp" may go with them.
  bool may_sum_by_parts = false;
};

Operators operators_of(const meshes::Mesh& mesh, const Options& options);

}  // namespace diptych::sph
