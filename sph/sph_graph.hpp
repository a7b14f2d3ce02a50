#pragma once
/// Total Lagrangian SPH as a pair graph: paper (19) with linear gradient correction and the
/// exact boundary closure of notes 3.3, by the least change of the C_ab.

#include "common/scheme/graph/operators.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::sph {

struct Options {
  std::string kernel = "cubic-spline";  ///< cubic-spline, quintic-spline, wendland-c2
  double kappa = 1.2;                   ///< h_a = kappa (Omega_a / filled part of the angle)^(1/d)
  bool closure = true;                  ///< repair the closure
  std::string gradient = "corrected";   ///< corrected, sbp or auto: sbp where it is sure to do
  std::string second_order_because = {};  ///< auto: corrected, for this reason, unless empty
  /// auto: off boxes, for this reason unless empty, those alone that bear any bulk pressure, in
  /// volumes of cells (notes 3.9)
  std::string strong_pressure_because = {};
};

/// What Options::gradient may be.
const std::vector<std::string>& gradient_names();

/// Pairs are those with |X_b - X_a| < support (h_a + h_b)/2, W_ab = W(|X_b - X_a|, (h_a + h_b)/2):
/// symmetric. Where cells are long in the mean, they are so for the nodes stretched to
/// cells of equal widths (scheme::on_equal_widths). Off boxes those across gaps and cracks
/// are dropped (gaps.hpp).
/// @throws base::InputError on an unknown kernel, kappa out of range, a particle with too few
///         (non-coplanar) neighbours: names it and its place; where sbp was asked for and the nodes
///         do not go with it
scheme::Operators operators_on(const meshes::Mesh& mesh, const Options& options);

/// Their graph alone.
scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options);

}  // namespace diptych::sph
