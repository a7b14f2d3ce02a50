#include "common/scheme/graph/pair_runs.hpp"

#include "common/algebra/field.hpp"

#include <algorithm>
#include <cstdlib>

namespace diptych::scheme {

using algebra::n_lanes;

namespace {

/// Of nodes a and b, as inside a lattice.
bool same_offsets(const PairGraph& graph, std::int64_t a, std::int64_t b) {
  const auto first = graph.neighbour.begin();
  return std::equal(first + graph.row[a], first + graph.row[a + 1], first + graph.row[b],
                    first + graph.row[b + 1],
                    [&](std::int32_t of_a, std::int32_t of_b) { return of_a - a == of_b - b; });
}

}  // namespace

PairRuns find_runs(const PairGraph& graph) {
  PairRuns runs;
  const std::int64_t n_blocks = algebra::n_blocks_of(graph.n_nodes());
  runs.row.assign(1, 0);
  std::vector<std::int32_t> offsets;
  for (std::int64_t b = 0; b < n_blocks; ++b) {
    offsets.clear();
    const std::int64_t end = std::min(graph.n_nodes(), (b + 1) * n_lanes);
    for (std::int64_t a = b * n_lanes; a < end; ++a) {
      if (a > b * n_lanes && same_offsets(graph, a - 1, a)) continue;
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
        offsets.push_back(graph.neighbour[p] - static_cast<std::int32_t>(a));
    }
    std::sort(offsets.begin(), offsets.end());
    offsets.erase(std::unique(offsets.begin(), offsets.end()), offsets.end());
    for (const std::int32_t offset : offsets)
      runs.reach = std::max<std::int64_t>(runs.reach, std::abs(offset));
    runs.offset.insert(runs.offset.end(), offsets.begin(), offsets.end());
    runs.row.push_back(static_cast<std::int64_t>(runs.offset.size()));
  }
  const auto lanes = static_cast<double>(runs.offset.size()) * n_lanes;
  runs.filling = lanes > 0 ? static_cast<double>(graph.n_pairs()) / lanes : 0;
  return runs;
}

PairRuns upward(const PairRuns& runs) {
  PairRuns half;
  half.row.assign(1, 0);
  half.reach = runs.reach;
  half.filling = runs.filling;
  for (size_t b = 0; b + 1 < runs.row.size(); ++b) {
    for (std::int64_t k = runs.row[b]; k < runs.row[b + 1]; ++k)
      if (runs.offset[k] > 0) half.offset.push_back(runs.offset[k]);
    half.row.push_back(static_cast<std::int64_t>(half.offset.size()));
  }
  return half;
}

void pairs_of_block(const PairGraph& graph,
                    const PairRuns& runs,
                    std::int64_t b,
                    std::vector<std::int64_t>& pair) {
  const std::int64_t n_chunks = runs.row[b + 1] - runs.row[b];
  pair.assign(static_cast<size_t>(n_chunks * n_lanes), -1);
  const std::int64_t end = std::min(graph.n_nodes(), (b + 1) * n_lanes);
  for (std::int64_t a = b * n_lanes; a < end; ++a) {
    std::int64_t chunk = 0;
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int64_t offset = graph.neighbour[p] - a;
      while (chunk < n_chunks && runs.offset[runs.row[b] + chunk] < offset)
        ++chunk;
      if (chunk < n_chunks && runs.offset[runs.row[b] + chunk] == offset)
        pair[chunk * n_lanes + a % n_lanes] = p;
    }
  }
}

}  // namespace diptych::scheme
