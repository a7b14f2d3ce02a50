#pragma once
/// Scenes of the kernel benchmarks: a strained, moving cube of 29^3 nodes (a working set far beyond
/// the second-level cache), as a body that kernels are called on one by one, and as a
/// solver for whole stages.

#include "common/run/solver.hpp"
#include "common/scheme/body/material_model.hpp"
#include "common/scheme/body/relaxation.hpp"

#include <memory>
#include <optional>
#include <string>

namespace diptych::micro {

/// "sph-52": SPH, cubic spline, kappa 1.2; "fvm-hex": edge stencil; "fvm-tet". With " moved" behind
/// it on nodes moved at random, where every row has a geometry of its own; with " mixed" or
/// " single" at the end in that precision.
struct SceneChoice {
  std::string graph = "sph-52";
  int n_branches = 0;
  bool face_correction = false;
  std::optional<scheme::Arrangement> arrangement = {};  ///< none: as the graph suggests
};

cases::Case case_of(const SceneChoice& choice, const std::string& integrator = "ssp-rk3");

/// Built once per kind and kept.
const scheme::PairGraph& graph_of(const std::string& graph);

/// A body as the sweeps see it, in the middle of its motion.
struct Scene {
  std::shared_ptr<const scheme::MaterialModel> material;
  scheme::Body<3> body;
  scheme::Relaxation frozen;  ///< as in cases without branches

  explicit Scene(const SceneChoice& choice);
};

}  // namespace diptych::micro
