#pragma once
/// The multipliers of quadratic_correction.hpp that change nothing: (y, Y h) = (phi, h grad phi /
/// 3) with cubics phi. Test: tests/graphs/summation_by_parts_test.cpp

#include "common/closure/conjugate_gradients.hpp"
#include "common/scheme/graph/pair_graph.hpp"

namespace diptych::closure {

class CubicPart {
 public:
  /// @param h [n_nodes] spacings  [m]
  CubicPart(const scheme::PairGraph& graph, const std::vector<double>& h);

  /// Takes it out of a field of 1 + dimension vectors a node.
  void remove(Field& r) const;

 private:
  int dimension_ = 3;
  std::vector<double> basis_;  ///< [n_nodes][1 + dimension][n_terms] orthonormal
  int n_terms_ = 0;
};

}  // namespace diptych::closure
