#pragma once
/// The streams of memory that pair sweeps go through, and what of them a rank never reads.
/// Test: tests/ranks

#include "common/scheme/ranks/division.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace diptych::scheme {

/// Rows of chunks, or of what else stands in runs of one after the other, by unit: a node or a
/// block.
class Streams {
 public:
  /// @param untouched  ranges of units, ascending
  Streams(algebra::AlignedArray<std::int64_t>& row,
          algebra::AlignedArray<std::int64_t>& first,
          std::vector<parallel::NodeRange> untouched)
      : row_(row), first_(first), untouched_(std::move(untouched)) {}

  /// Gives back what has an entry for each chunk.
  template <class T>
  void release_chunks(algebra::AlignedArray<T>& values) const {
    if (values.size() == 0) return;
    Blocks chunks;
    for (const parallel::NodeRange& units : untouched_)
      chunks.push_back({row_[units.begin], row_[units.end]});
    give_back_blocks(values.data(), values.size(), 1, chunks);
  }
  /// Gives back the rows themselves, at last; those that are kept need the end of the one before.
  void release_rows() const {
    Blocks inner;
    for (const parallel::NodeRange& units : untouched_)
      inner.push_back({units.begin + 1, units.end});
    give_back_blocks(row_.data(), row_.size(), 1, inner);
    give_back_blocks(first_.data(), first_.size(), 1, untouched_);
  }
  /// Of geometry, which may stand once for several units: what none of the others has.
  Blocks unused_geometry(std::int64_t size) const {
    std::vector<char> is_used(static_cast<size_t>(size));
    std::int64_t unit = 0;
    const auto use_until = [&](std::int64_t end) {
      for (; unit < end; ++unit) {
        for (std::int64_t k = 0; k < row_[unit + 1] - row_[unit]; ++k)
          is_used[static_cast<size_t>(first_[unit] + k)] = 1;
      }
    };
    for (const parallel::NodeRange& units : untouched_) {
      use_until(units.begin);
      unit = units.end;
    }
    use_until(first_.size());
    return parallel::ranges_of(
        size, [&](std::int64_t k) { return is_used[static_cast<size_t>(k)] == 0; });
  }

 private:
  algebra::AlignedArray<std::int64_t>&row_, &first_;
  std::vector<parallel::NodeRange> untouched_;
};

/// Units of blocks: these in runs, nodes in rows.
template <int Dim>
std::vector<parallel::NodeRange> units_of(const Body<Dim>& body,
                                          const Blocks& blocks,
                                          std::int64_t n_units) {
  std::vector<parallel::NodeRange> units;
  const std::int64_t n = body.in_runs() ? 1 : algebra::n_lanes;
  for (const parallel::NodeRange& range : blocks)
    units.push_back({range.begin * n, std::min(n_units, range.end * n)});
  return units;
}

/// By node or block.
template <int Dim>
Streams pair_streams(Body<Dim>& body) {
  SweepGraph<Dim>& graph = body.graph;
  return {graph.row, graph.first,
          units_of(body, body.division->untouched.owned, graph.first.size())};
}
template <int Dim>
Streams slope_streams(Body<Dim>& body) {
  SlopeGraph<Dim>& slopes = body.graph.slopes;
  return {slopes.row, slopes.first,
          units_of(body, body.division->untouched.owned, slopes.first.size())};
}
/// @pre body.in_runs()
template <int Dim>
Streams mutual_streams(Body<Dim>& body) {
  MutualPairs<Dim>& mutual = body.graph.mutual;
  return {mutual.row, mutual.first, body.division->untouched.worked};
}

/// use(bytes, size, bytes of an entry, entries that this rank does not use) of all arrays of
/// geometry.
template <int Dim, class Use>
void for_geometry(Body<Dim>& body, const Use& use) {
  SweepGraph<Dim>& graph = body.graph;
  const auto use_array = [&](auto& values, const Blocks& unused) {
    if (values.size() > 0)
      use(parallel::bytes_of(values.data()), values.size(),
          static_cast<std::int64_t>(sizeof *values.data()), unused);
  };
  const auto use_geometry = [&](auto& values, const Blocks& unused) {
    if (values.size() == 0) return;
    values.change(0, [&](auto& first) {
      use(parallel::bytes_of(&first), values.size(), static_cast<std::int64_t>(sizeof first),
          unused);
    });
  };
  const Blocks of_pairs = pair_streams(body).unused_geometry(graph.strain.size());
  use_geometry(graph.strain, of_pairs);
  use_geometry(graph.force, of_pairs);
  use_array(graph.area, of_pairs);
  use_array(graph.face, of_pairs);
  if (!graph.slopes.empty())
    use_array(graph.slopes.weights,
              slope_streams(body).unused_geometry(graph.slopes.weights.size()));
  if (body.in_runs()) {
    use_geometry(graph.mutual.geometry,
                 mutual_streams(body).unused_geometry(graph.mutual.geometry.size()));
  }
}

}  // namespace diptych::scheme
