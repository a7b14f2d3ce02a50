#pragma once
/// Total Lagrangian SPH as a pair graph: paper (19) with linear gradient correction and the
/// minimum-norm boundary (gamma) closure of physics note 3.3.

#include "common/scheme/pair_graph.hpp"
#include "meshes/mesh.hpp"

#include <string>

namespace diptych::sph {

struct Options {
  std::string kernel = "cubic-spline";  ///< cubic-spline, quintic-spline, wendland-c2
  double kappa = 1.2;                   ///< smoothing length h_a = kappa Omega_a^(1/d)
  bool closure = true;                  ///< gamma repair
};

/// @throws base::InputError on an unknown kernel, kappa out of range, a particle with too few
///         (non-coplanar) neighbours: names it and its place
scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options);

}  // namespace diptych::sph
