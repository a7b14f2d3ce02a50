#include "common/scheme/ranks/untouched.hpp"

#include "common/scheme/ranks/division.hpp"

namespace diptych::scheme {

namespace {

using algebra::n_lanes;
using parallel::NodeRange;

void give_back(std::byte* bytes, size_t n) {
  parallel::give_back(bytes, static_cast<std::int64_t>(n));
}

void keep_small(std::byte* bytes, size_t n) {
  parallel::keep_pages_small(bytes, static_cast<std::int64_t>(n));
}

/// n components from `first` on of a table, of all its blocks.
void release_table(
    NodeTable& table, std::int64_t n_blocks, int first, int n, const Blocks& untouched) {
  table.for_pieces(0, n_blocks * n_lanes, first, n, keep_small);
  for (const NodeRange& blocks : untouched)
    table.for_pieces(blocks.begin * n_lanes, blocks.end * n_lanes, first, n, give_back);
}

/// Rows of chunks, or of what else stands in runs of one after the other, by unit: a node or a
/// block.
class Streams {
 public:
  /// @param untouched  ranges of units, ascending
  Streams(algebra::AlignedArray<std::int64_t>& row,
          algebra::AlignedArray<std::int64_t>& first,
          std::vector<NodeRange> untouched)
      : row_(row), first_(first), untouched_(std::move(untouched)) {}

  /// What has an entry for each chunk.
  template <class T>
  void release_chunks(algebra::AlignedArray<T>& values) const {
    if (values.size() == 0) return;
    std::vector<NodeRange> chunks;
    for (const NodeRange& units : untouched_)
      chunks.push_back({row_[units.begin], row_[units.end]});
    give_back_blocks(values.data(), values.size(), 1, chunks);
  }
  /// Geometry, which may stand once for several units: what none of the others has.
  /// @param bytes  of an entry
  void release_geometry(std::byte* values, std::int64_t size, std::int64_t bytes) const {
    std::vector<char> is_used(static_cast<size_t>(size));
    std::int64_t unit = 0;
    const auto use_until = [&](std::int64_t end) {
      for (; unit < end; ++unit) {
        for (std::int64_t k = 0; k < row_[unit + 1] - row_[unit]; ++k)
          is_used[static_cast<size_t>(first_[unit] + k)] = 1;
      }
    };
    for (const NodeRange& units : untouched_) {
      use_until(units.begin);
      unit = units.end;
    }
    use_until(first_.size());
    Blocks unused = parallel::ranges_of(
        size, [&](std::int64_t k) { return is_used[static_cast<size_t>(k)] == 0; });
    give_back_blocks(values, size * bytes, bytes, unused);
  }
  template <class T>
  void release_geometry(algebra::AlignedArray<T>& values) const {
    if (values.size() > 0)
      release_geometry(parallel::bytes_of(values.data()), values.size(), sizeof(T));
  }
  template <template <int, class> class Geometry, int Dim>
  void release_geometry(GeometryArray<Geometry, Dim>& values) const {
    if (values.size() == 0) return;
    values.change(0, [&](auto& geometry) {
      release_geometry(parallel::bytes_of(&geometry), values.size(), sizeof geometry);
    });
  }
  /// At last the rows themselves; those that are kept need the end of the one before.
  void release_rows() const {
    std::vector<NodeRange> inner;
    for (const NodeRange& units : untouched_)
      inner.push_back({units.begin + 1, units.end});
    give_back_blocks(row_.data(), row_.size(), 1, inner);
    give_back_blocks(first_.data(), first_.size(), 1, untouched_);
  }

 private:
  algebra::AlignedArray<std::int64_t>&row_, &first_;
  std::vector<NodeRange> untouched_;
};

/// Units of blocks: these in runs, nodes in rows.
template <int Dim>
std::vector<NodeRange> units_of(const Body<Dim>& body, const Blocks& blocks, std::int64_t n_units) {
  std::vector<NodeRange> units;
  const std::int64_t n = body.in_runs() ? 1 : n_lanes;
  for (const NodeRange& range : blocks)
    units.push_back({range.begin * n, std::min(n_units, range.end * n)});
  return units;
}

template <int Dim>
void release_pairs(Body<Dim>& body, const Untouched& untouched) {
  SweepGraph<Dim>& graph = body.graph;
  const Streams pairs(graph.row, graph.first, units_of(body, untouched.owned, graph.first.size()));
  pairs.release_chunks(graph.neighbours);
  pairs.release_chunks(graph.offset);
  pairs.release_geometry(graph.strain);
  pairs.release_geometry(graph.force);
  pairs.release_geometry(graph.area);
  pairs.release_geometry(graph.face);
  pairs.release_rows();
  if (!graph.slopes.empty()) {
    const Streams slopes(graph.slopes.row, graph.slopes.first,
                         units_of(body, untouched.owned, graph.slopes.first.size()));
    slopes.release_chunks(graph.slopes.neighbours);
    slopes.release_chunks(graph.slopes.offset);
    slopes.release_geometry(graph.slopes.weights);
    slopes.release_rows();
  }
  if (!body.in_runs()) return;
  const Streams mutual(graph.mutual.row, graph.mutual.first, untouched.worked);
  mutual.release_chunks(graph.mutual.offset);
  mutual.release_geometry(graph.mutual.geometry);
  mutual.release_rows();
}

}  // namespace

Untouched untouched_of(std::int64_t n_blocks,
                       const std::vector<char>& owned,
                       const std::vector<char>& read,
                       const std::vector<char>& written,
                       const std::vector<char>& worked) {
  const auto blocks_without = [&](const std::vector<char>& kind) {
    Blocks blocks = parallel::ranges_of(
        std::ssize(owned), [&](std::int64_t c) { return owned[c] == 0 && kind[c] == 0; });
    for (NodeRange& range : blocks) {
      range.begin *= parallel::chunk_size;
      range.end = std::min(n_blocks, range.end * parallel::chunk_size);
    }
    return blocks;
  };
  return {blocks_without(owned), blocks_without(read), blocks_without(written),
          blocks_without(worked)};
}

template <int Dim>
void release_fields(Body<Dim>& body) {
  const Untouched& untouched = body.division->untouched;
  for (const Field<Dim>& field : body.fields()) {
    if (field.block != nullptr) {
      give_back_blocks(body.*field.block, body.n_blocks, untouched.owned);
      continue;
    }
    const bool is_force = field.role == Role::accumulated;
    release_table(body.*field.table, body.n_blocks, field.first, field.n_components,
                  is_force ? untouched.written : untouched.read);
  }
}

template <int Dim>
void release_graph(Body<Dim>& body) {
  const Untouched& untouched = body.division->untouched;
  SweepGraph<Dim>& graph = body.graph;
  release_pairs(body, untouched);
  release_table(graph.X, body.n_blocks, 0, Dim, untouched.read);
  give_back_blocks(graph.inverse_Omega.data(), graph.inverse_Omega.size(), n_lanes,
                   untouched.owned);
  give_back_blocks(graph.Omega.data(), graph.Omega.size(), n_lanes, untouched.owned);
  if (!graph.C_sum.empty()) give_back_blocks(graph.C_sum, body.n_blocks, untouched.owned);
  if (!body.bulk) give_back_blocks(body.X.data(), std::ssize(body.X), n_lanes, untouched.owned);
}

#define DIPTYCH_INSTANTIATE(Dim)            \
  template void release_fields(Body<Dim>&); \
  template void release_graph(Body<Dim>&);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
