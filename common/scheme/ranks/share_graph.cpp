#include "common/scheme/ranks/share_graph.hpp"

#include "common/parallel/sharing.hpp"
#include "common/scheme/ranks/streams.hpp"

namespace diptych::scheme {

namespace {

using algebra::AlignedArray;
using parallel::Communicator;
using parallel::share;

/// Of an array that other ranks have yet to make.
template <class Array>
void share_size(Communicator& ranks, AlignedArray<Array>& values) {
  std::int64_t n = values.size();
  share(ranks, n);
  if (ranks.rank() != 0) values = AlignedArray<Array>(n);
}
template <template <int, class> class Geometry, int Dim>
void share_size(Communicator& ranks, GeometryArray<Geometry, Dim>& values) {
  std::int64_t n = values.size();
  bool is_single = values.is_single();
  share(ranks, n);
  share(ranks, is_single);
  if (ranks.rank() != 0) values = GeometryArray<Geometry, Dim>(n, is_single);
}

template <class T>
void share_array(Communicator& ranks, AlignedArray<T>& values) {
  share_size(ranks, values);
  ranks.broadcast(parallel::bytes_of(values.data()), values.bytes());
}

/// Shares pieces of memory one by one.
auto sharing(Communicator& ranks) {
  return [&ranks](std::byte* bytes, size_t n) {
    ranks.broadcast(bytes, static_cast<std::int64_t>(n));
  };
}

template <int Dim>
void share_slopes(Communicator& ranks, SlopeGraph<Dim>& slopes) {
  share_array(ranks, slopes.row);
  share_array(ranks, slopes.neighbours);
  share_array(ranks, slopes.offset);
  share_array(ranks, slopes.first);
  share_size(ranks, slopes.weights);
}

template <int Dim>
void share_mutual(Communicator& ranks, MutualPairs<Dim>& mutual) {
  share_array(ranks, mutual.row);
  share_array(ranks, mutual.offset);
  share_array(ranks, mutual.first);
  share_size(ranks, mutual.geometry);
  share(ranks, mutual.order.segment);
  share(ranks, mutual.order.layer);
  share(ranks, mutual.order.forces);
}

void share_patch(Communicator& ranks, BoundaryPatch& patch) {
  share(ranks, patch.name);
  share(ranks, patch.nodes);
  share(ranks, patch.area);
  share(ranks, patch.faces);
}

void share_lines(Communicator& ranks, VolumeLines& lines) {
  auto n = std::ssize(lines.along);
  share(ranks, n);
  lines.along.resize(static_cast<size_t>(n));
  for (LineDerivative& along : lines.along) {
    share(ranks, along.H);
    along.row.resize(along.H.size());
    for (std::vector<LineDerivative::Entry>& row : along.row)
      share(ranks, row);
  }
  share(ranks, lines.place);
  share(ranks, lines.node);
  share(ranks, lines.cell);
}

}  // namespace

void share_nodes(Communicator& ranks, PairGraph& graph, Volumes volumes) {
  share(ranks, graph.dimension);
  share(ranks, graph.X);
  share(ranks, graph.Omega);
  auto n_patches = std::ssize(graph.patches);
  share(ranks, n_patches);
  graph.patches.resize(static_cast<size_t>(n_patches));
  for (BoundaryPatch& patch : graph.patches)
    share_patch(ranks, patch);
  if (volumes == Volumes::cells) {
    share(ranks, graph.cells.row);
    share(ranks, graph.cells.corner);
    share(ranks, graph.cells.share);
  }
  if (volumes == Volumes::lines) share_lines(ranks, graph.lines);
  share(ranks, graph.edges);
}

template <int Dim>
void share_indices(Communicator& ranks, SweepGraph<Dim>& graph) {
  for (std::int64_t* n : {&graph.n_nodes, &graph.n_blocks, &graph.n_pairs})
    share(ranks, *n);
  share(ranks, graph.shape);
  share_array(ranks, graph.row);
  share_array(ranks, graph.neighbours);
  share_array(ranks, graph.offset);
  share_array(ranks, graph.first);
  share_size(ranks, graph.strain);
  share_size(ranks, graph.force);
  share_size(ranks, graph.area);
  share_size(ranks, graph.face);
  share_mutual(ranks, graph.mutual);
  share_slopes(ranks, graph.slopes);
  share_array(ranks, graph.Omega);
  share_array(ranks, graph.inverse_Omega);
  if (ranks.rank() != 0) {
    const bool in_rows = graph.shape.arrangement == Arrangement::rows;
    graph.X = algebra::NodeTable(graph.n_nodes, Dim, vector_stride<Dim>, graph.shape);
    graph.C_sum = algebra::BlockField(in_rows ? graph.n_nodes : 0, Dim);
  }
  graph.X.for_pieces(0, graph.n_blocks * algebra::n_lanes, 0, Dim, sharing(ranks));
  if (!graph.C_sum.empty()) graph.C_sum.for_pieces(0, graph.n_blocks, sharing(ranks));
}

template <int Dim>
void share_geometry(Body<Dim>& body) {
  Communicator& ranks = body.division->part.ranks();
  constexpr std::int64_t piece_bytes = 1 << 22;
  std::vector<std::byte> piece;
  for_geometry(body, [&](std::byte* values, std::int64_t size, std::int64_t bytes,
                         const Blocks& unused) {
    const std::int64_t length = std::max<std::int64_t>(1, piece_bytes / bytes);
    auto gap = unused.begin();
    for (std::int64_t begin = 0; begin < size; begin += length) {
      const std::int64_t end = std::min(size, begin + length);
      if (ranks.rank() == 0) {
        ranks.broadcast(values + begin * bytes, (end - begin) * bytes);
        continue;
      }
      piece.resize(static_cast<size_t>((end - begin) * bytes));
      ranks.broadcast(piece.data(), std::ssize(piece));
      for (std::int64_t k = begin; k < end;) {
        while (gap != unused.end() && gap->end <= k)
          ++gap;
        const std::int64_t next = gap == unused.end() ? end : std::min(end, gap->begin);
        if (k < next)
          std::copy_n(piece.data() + (k - begin) * bytes, (next - k) * bytes, values + k * bytes);
        k = next < end && gap != unused.end() ? std::min(end, gap->end) : end;
      }
    }
  });
}

template <int Dim>
void share_last_block(Body<Dim>& body) {
  const auto use = sharing(body.division->part.ranks());
  const std::int64_t end = body.n_blocks, begin = end - 1;
  for (const Field<Dim>& field : body.fields()) {
    if (field.block != nullptr) {
      (body.*field.block).for_pieces(begin, end, use);
    } else {
      (body.*field.table)
          .for_pieces(begin * algebra::n_lanes, end * algebra::n_lanes, field.first,
                      field.n_components, use);
    }
  }
}

#define DIPTYCH_INSTANTIATE(Dim)                                          \
  template void share_indices(parallel::Communicator&, SweepGraph<Dim>&); \
  template void share_geometry(Body<Dim>&);                               \
  template void share_last_block(Body<Dim>&);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
