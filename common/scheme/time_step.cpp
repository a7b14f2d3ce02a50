#include "common/scheme/time_step.hpp"

#include <algorithm>

namespace diptych::scheme {

double geometric_rate(const PairGraph& graph) {
  double largest = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    double sum = 0;
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k)
      sum += graph.C[k].norm();
    largest = std::max(largest, 0.5 * sum / graph.Omega[a]);
  }
  return largest;
}

}  // namespace diptych::scheme
