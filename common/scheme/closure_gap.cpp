#include "common/scheme/closure_gap.hpp"

#include <cmath>

namespace diptych::scheme {

Field closure_gap(const PairGraph& graph) {
  Field gap = graph.boundary_area;
  for_each_node(gap.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      Vec3 sum = Vec3::Zero();
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        sum += graph.C[p] - graph.C[graph.reverse[p]];
      }
      gap[a] += 0.5 * sum;
    }
  });
  return gap;
}

std::vector<double> area_units(const PairGraph& graph) {
  std::vector<double> unit(graph.Omega.size());
  const double power = (1.0 - graph.dimension) / graph.dimension;
  for (size_t a = 0; a < unit.size(); ++a)
    unit[a] = std::pow(graph.Omega[a], power);
  return unit;
}

}  // namespace diptych::scheme
