#include "common/scheme/graph/work_order.hpp"

#include "common/algebra/field.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>

namespace diptych::scheme {

using algebra::n_lanes;

namespace {

constexpr std::int64_t nodes_of_chunk = parallel::chunk_size * n_lanes;

/// Chunks of a tile in a layer.
constexpr std::int64_t tile = 2;

/// Blocks of a segment: at least the reach of the pairs, and such that the segments of a phase
/// (2^k or 3 2^k of them) divide evenly among two threads, and mostly among more.
std::int64_t segment_of(std::int64_t n_blocks, std::int64_t reach) {
  constexpr std::int64_t unit = parallel::chunk_size;
  const std::int64_t n_units = std::max<std::int64_t>(1, (n_blocks + unit - 1) / unit);
  const std::int64_t least =
      std::max<std::int64_t>(1, (reach + n_lanes * unit - 1) / (n_lanes * unit));
  const std::int64_t most = n_units / least;
  std::int64_t n_segments = 1;
  for (std::int64_t n = 2; n <= most; n *= 2)
    n_segments = n >= 4 && n / 2 * 3 <= most ? n / 2 * 3 : n;
  return unit * ((n_units + n_segments - 1) / n_segments);
}

}  // namespace

void find_reached(std::span<const std::int64_t> row,
                  std::span<const std::int32_t> offset,
                  std::int64_t c,
                  std::vector<std::int64_t>& reached) {
  const std::int64_t n_blocks = std::ssize(row) - 1;
  const std::int64_t last = parallel::n_chunks_of(n_blocks) - 1;
  const std::int64_t begin = c * parallel::chunk_size,
                     end = std::min(n_blocks, begin + parallel::chunk_size);
  reached.assign(1, c);
  for (std::int64_t b = begin; b < end; ++b) {
    for (std::int64_t k = row[b]; k < row[b + 1]; ++k) {
      const std::int64_t node = b * n_lanes + offset[k];
      for (const std::int64_t at : {node, node + n_lanes - 1}) {
        const std::int64_t chunk = std::min(at / nodes_of_chunk, last);
        if (chunk != reached.back()) reached.push_back(chunk);
      }
    }
  }
  std::sort(reached.begin(), reached.end());
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
}

std::int64_t layer_of(const PairRuns& upward) {
  const std::int64_t n_blocks = std::ssize(upward.row) - 1;
  // one that is far from the sides has the most neighbours
  constexpr std::int64_t n_looked_at = 64;
  const auto n_of = [&](std::int64_t b) { return upward.row[b + 1] - upward.row[b]; };
  std::int64_t middle = 0, largest = 0, before = 0;
  for (std::int64_t k = 0; k < n_looked_at; ++k) {
    const std::int64_t b = n_blocks * (n_looked_at + k) / (3 * n_looked_at);
    middle = n_of(b) > n_of(middle) ? b : middle;
  }
  const auto begin = upward.offset.begin() + upward.row[middle],
             end = upward.offset.begin() + upward.row[middle + 1];
  for (auto at = begin; at != end; before = *at++)
    largest = std::max<std::int64_t>(largest, *at - before);
  // the first offsets beyond a gap, up to the next one
  before = 0;
  for (auto at = begin; at != end; before = *at++) {
    if (2 * (*at - before) < largest) continue;
    auto last = at;
    while (last + 1 != end && 2 * (last[1] - last[0]) < largest)
      ++last;
    return (*at + *last) / 2;
  }
  return 0;
}

std::int64_t WorkOrder::n_segments() const {
  const std::int64_t length = segment / parallel::chunk_size;
  return (std::ssize(forces) + length - 1) / length;
}

std::span<const std::int32_t> WorkOrder::forces_of(std::int64_t s) const {
  const std::int64_t length = segment / parallel::chunk_size, begin = s * length;
  return std::span(forces).subspan(begin, std::min(length, std::ssize(forces) - begin));
}

WorkOrder work_order(const PairRuns& upward) {
  const std::int64_t n_blocks = std::ssize(upward.row) - 1;
  const std::int64_t n_chunks = parallel::n_chunks_of(n_blocks);
  WorkOrder order;
  order.layer = layer_of(upward);
  order.segment = segment_of(n_blocks, upward.reach);
  const std::int64_t length = order.segment / parallel::chunk_size;
  const auto tile_of = [&](std::int64_t chunk) {
    return order.has_large_layers() ? chunk * nodes_of_chunk % order.layer / (tile * nodes_of_chunk)
                                    : 0;
  };
  for (std::int64_t begin = 0; begin < n_chunks; begin += length) {
    for (std::int64_t c = begin; c < std::min(n_chunks, begin + length); ++c)
      order.forces.push_back(static_cast<std::int32_t>(c));
    std::stable_sort(order.forces.begin() + begin, order.forces.end(),
                     [&](auto a, auto b) { return tile_of(a) < tile_of(b); });
  }
  std::vector<std::vector<std::int32_t>> stages(static_cast<size_t>(order.n_segments()));
  std::vector<char> is_evaluated(static_cast<size_t>(n_chunks));
  std::vector<std::int64_t> reached;
  for (const std::int64_t parity : {0, 1}) {
    for (std::int64_t s = parity; s < order.n_segments(); s += 2) {
      for (const std::int32_t c : order.forces_of(s)) {
        find_reached(upward.row, upward.offset, c, reached);
        for (const std::int64_t at : reached) {
          if (is_evaluated[at] == 0) stages[s].push_back(~static_cast<std::int32_t>(at));
          is_evaluated[at] = 1;
        }
        stages[s].push_back(c);
      }
    }
  }
  order.first.assign(1, 0);
  for (const auto& of_segment : stages) {
    order.stage.insert(order.stage.end(), of_segment.begin(), of_segment.end());
    order.first.push_back(std::ssize(order.stage));
  }
  return order;
}

}  // namespace diptych::scheme
