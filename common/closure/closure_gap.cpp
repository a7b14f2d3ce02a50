#include "common/closure/closure_gap.hpp"

#include <cmath>

namespace diptych::closure {

namespace {

Vec3 gap_of(const scheme::PairGraph& graph, std::int64_t a) {
  Vec3 sum = Vec3::Zero();
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
    sum += graph.C[p] - graph.C[graph.reverse(p)];
  return graph.boundary_area[a] + 0.5 * sum;
}

}  // namespace

Field closure_gap(const scheme::PairGraph& graph) {
  Field gap(graph.X.size());
  for_each_node(gap.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a)
      gap[a] = gap_of(graph, a);
  });
  return gap;
}

void update_closure_gap(const scheme::PairGraph& graph,
                        const std::vector<char>& changed,
                        Field& gap) {
  for_each_node(gap.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a)
      if (changed[a]) gap[a] = gap_of(graph, a);
  });
}

std::vector<double> area_units(const scheme::PairGraph& graph) {
  std::vector<double> unit(graph.Omega.size());
  const double power = (1.0 - graph.dimension) / graph.dimension;
  for (size_t a = 0; a < unit.size(); ++a)
    unit[a] = std::pow(graph.Omega[a], power);
  return unit;
}

}  // namespace diptych::closure
