#pragma once
/// A pair graph with what its factory made of the mesh.

#include "common/scheme/graph/pair_graph.hpp"

#include <string>
#include <vector>

namespace diptych::scheme {

struct Operators {
  PairGraph graph;
  std::string text;                  ///< for the record; empty where they were asked for by name
  std::vector<std::string> notices;  ///< where they are less than could be, or promise less
  /// Off boxes, of those that sum by parts: what linear reconstructions leave of jumps may give
  /// energy to some motions, unless they have their adjoint or a limiter keeps the sign of the
  /// jumps (notes 3.4, 4.5, 4.6).
  bool loses_sign = false;
  /// Of second order, whose nodes see short waves so badly that volumes and shear of cells err less
  /// (notes 3.11).
  bool errs_less_with_cells = false;
};

}  // namespace diptych::scheme
