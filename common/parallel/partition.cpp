#include "common/parallel/partition.hpp"

#include "common/parallel/ranks.hpp"

#include <algorithm>
#include <numeric>

namespace diptych::parallel {

namespace {

/// Chunks of `order` to n parts, first to first + n - 1, so that each has about the same work and
/// none is empty.
void deal(const ChunkGraph& graph,
          const std::vector<std::int32_t>& order,
          int n_parts,
          std::vector<int>& owner) {
  std::int64_t left = 0;
  for (const std::int32_t chunk : order)
    left += graph.work[chunk];
  size_t next = 0;
  for (int part = 0; part < n_parts; ++part) {
    const int parts_left = n_parts - part;
    std::int64_t sum = 0;
    for (bool is_first = true; next < order.size(); ++next, is_first = false) {
      const std::int64_t work = graph.work[order[next]];
      const bool is_full = (2 * sum + work) * parts_left > 2 * left;
      const auto chunks_left = static_cast<int>(order.size() - next);
      if (!is_first && parts_left > 1 && (is_full || chunks_left < parts_left)) break;
      sum += work;
      owner[order[next]] = part;
    }
    left -= sum;
  }
}

std::vector<int> slabs(const ChunkGraph& graph, int n_parts) {
  std::vector<int> owner(graph.work.size());
  std::vector<std::int32_t> order(owner.size());
  std::iota(order.begin(), order.end(), 0);
  deal(graph, order, n_parts, owner);
  return owner;
}

/// Gives chunks to parts first to first + n_parts - 1.
void bisect(const ChunkGraph& graph,
            std::vector<std::int32_t> chunks,
            int first,
            int n_parts,
            std::vector<int>& owner) {
  if (n_parts == 1) {
    for (const std::int32_t chunk : chunks)
      owner[chunk] = first;
    return;
  }
  size_t longest = 0;
  double length = -1;
  for (size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax_element(chunks.begin(), chunks.end(), [&](auto a, auto b) {
      return graph.centre[a][i] < graph.centre[b][i];
    });
    const double side = graph.centre[*high][i] - graph.centre[*low][i];
    if (side > length) {
      length = side;
      longest = i;
    }
  }
  std::stable_sort(chunks.begin(), chunks.end(), [&](auto a, auto b) {
    return graph.centre[a][longest] < graph.centre[b][longest];
  });
  const int n_lower = n_parts / 2;
  std::int64_t all = 0, sum = 0;
  for (const std::int32_t chunk : chunks)
    all += graph.work[chunk];
  auto cut = static_cast<std::ptrdiff_t>(n_lower);
  const auto most = std::ssize(chunks) - (n_parts - n_lower);
  for (std::ptrdiff_t k = 0; k < cut; ++k)
    sum += graph.work[chunks[k]];
  for (; cut < most && (2 * sum + graph.work[chunks[cut]]) * n_parts <= 2 * all * n_lower; ++cut)
    sum += graph.work[chunks[cut]];
  bisect(graph, {chunks.begin(), chunks.begin() + cut}, first, n_lower, owner);
  bisect(graph, {chunks.begin() + cut, chunks.end()}, first + n_lower, n_parts - n_lower, owner);
}

std::vector<int> bisections(const ChunkGraph& graph, int n_parts) {
  std::vector<int> owner(graph.work.size());
  std::vector<std::int32_t> all(owner.size());
  std::iota(all.begin(), all.end(), 0);
  bisect(graph, std::move(all), 0, n_parts, owner);
  return owner;
}

/// METIS leaves parts empty where there are hardly more chunks than parts, and divides by zero
/// where there is one part.
std::vector<int> by_metis(const ChunkGraph& graph, int n_parts) {
  if (n_parts == 1) return slabs(graph, 1);
  std::vector<int> owner = metis_partition(graph, n_parts);
  std::vector<std::int64_t> n(static_cast<size_t>(n_parts));
  for (const int part : owner)
    ++n[part];
  return std::find(n.begin(), n.end(), 0) == n.end() ? owner : slabs(graph, n_parts);
}

}  // namespace

const base::Registry<Partitioner>& partitioners() {
  static const auto menu = base::Registry<Partitioner>("partition")
                               .add("metis", by_metis)
                               .add("slab", slabs)
                               .add("bisection", bisections);
  return menu;
}

double imbalance(const ChunkGraph& graph, const std::vector<int>& owner, int n_parts) {
  std::vector<double> work(static_cast<size_t>(n_parts));
  for (size_t chunk = 0; chunk < owner.size(); ++chunk)
    work[owner[chunk]] += static_cast<double>(graph.work[chunk]);
  const double all = std::accumulate(work.begin(), work.end(), 0.0);
  return all > 0 ? *std::max_element(work.begin(), work.end()) * n_parts / all : 1;
}

}  // namespace diptych::parallel
