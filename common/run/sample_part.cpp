#include "common/run/sample_part.hpp"

namespace diptych::run {

namespace {

using scheme::PairGraph;

/// Nodes of the part, ascending.
std::vector<std::int32_t> nodes_around(const PairGraph& graph,
                                       const std::vector<std::int32_t>& seeds,
                                       std::int64_t wanted) {
  std::vector<char> taken(graph.X.size(), 0);
  std::vector<std::int32_t> front = seeds, next;
  std::int64_t n = 0;
  for (const std::int32_t a : front)
    taken[a] = 1;
  while (!front.empty()) {
    n += std::ssize(front);
    if (n >= wanted) break;
    next.clear();
    for (const std::int32_t a : front) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const std::int32_t b = graph.neighbour[p];
        if (taken[b] == 0) next.push_back(b);
        taken[b] = 1;
      }
    }
    front.swap(next);
  }
  std::vector<std::int32_t> nodes;
  nodes.reserve(n);
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a)
    if (taken[a] != 0) nodes.push_back(static_cast<std::int32_t>(a));
  return nodes;
}

SamplePart part_of(const PairGraph& graph, const std::vector<std::int32_t>& nodes) {
  std::vector<std::int32_t> number(graph.X.size(), -1);
  for (size_t i = 0; i < nodes.size(); ++i)
    number[nodes[i]] = static_cast<std::int32_t>(i);
  SamplePart part;
  part.graph.dimension = graph.dimension;
  part.graph.dissipation_metric = graph.dissipation_metric;
  part.graph.precision = graph.precision;
  part.graph.boundary_area.assign(nodes.size(), algebra::Vec3::Zero());
  part.graph.row.assign(1, 0);
  size_t n_pairs = 0;  // at most
  for (const std::int32_t a : nodes)
    n_pairs += static_cast<size_t>(graph.row[a + 1] - graph.row[a]);
  part.graph.neighbour.reserve(n_pairs);
  std::vector<algebra::Vec3> C;
  C.reserve(n_pairs);
  for (const std::int32_t a : nodes) {
    part.graph.X.push_back(graph.X[a]);
    part.graph.Omega.push_back(graph.Omega[a]);
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int32_t b = number[graph.neighbour[p]];
      if (b < 0) continue;
      part.graph.neighbour.push_back(b);
      C.push_back(graph.C[p]);
    }
    part.graph.row.push_back(part.graph.n_pairs());
    const auto n = static_cast<std::int64_t>(part.graph.row.size());
    const bool whole =
        part.graph.row[n - 1] - part.graph.row[n - 2] == graph.row[a + 1] - graph.row[a];
    part.moves.push_back(whole ? 1 : 0);
  }
  part.graph.C = algebra::SharedVectors(std::move(C));
  scheme::link_reverse_pairs(part.graph);
  return part;
}

}  // namespace

std::optional<SamplePart> sample_part(const PairGraph& graph, std::int64_t wanted) {
  const std::vector<std::int32_t>& seeds = graph.classes.rows.representative;
  if (graph.n_nodes() < 3 * wanted || seeds.empty() || 20 * std::ssize(seeds) > wanted) return {};
  const std::vector<std::int32_t> nodes = nodes_around(graph, seeds, wanted);
  if (3 * std::ssize(nodes) > graph.n_nodes()) return {};
  return part_of(graph, nodes);
}

}  // namespace diptych::run
