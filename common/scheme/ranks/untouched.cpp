#include "common/scheme/ranks/untouched.hpp"

#include "common/scheme/ranks/streams.hpp"

namespace diptych::scheme {

namespace {

using algebra::n_lanes;
using parallel::NodeRange;

void give_back(std::byte* bytes, size_t n) {
  parallel::give_back(bytes, static_cast<std::int64_t>(n));
}

/// n components from `first` on of a table.
void release_table(NodeTable& table, int first, int n, const Blocks& untouched) {
  for (const NodeRange& blocks : untouched)
    table.for_pieces(blocks.begin * n_lanes, blocks.end * n_lanes, first, n, give_back);
}

template <int Dim>
void release_pairs(Body<Dim>& body) {
  SweepGraph<Dim>& graph = body.graph;
  for_geometry(body,
               [](std::byte* values, std::int64_t size, std::int64_t bytes, const Blocks& unused) {
                 give_back_blocks(values, size * bytes, bytes, unused);
               });
  const Streams pairs = pair_streams(body);
  pairs.release_chunks(graph.neighbours);
  pairs.release_chunks(graph.offset);
  pairs.release_rows();
  if (!graph.slopes.empty()) {
    const Streams slopes = slope_streams(body);
    slopes.release_chunks(graph.slopes.neighbours);
    slopes.release_chunks(graph.slopes.offset);
    slopes.release_rows();
  }
  if (!body.in_runs()) return;
  const Streams mutual = mutual_streams(body);
  mutual.release_chunks(graph.mutual.offset);
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
Blocks untouched_of(const Body<Dim>& body, const Field<Dim>& field) {
  if (!body.division) return {};
  const Untouched& untouched = body.division->untouched;
  if (field.block != nullptr) return untouched.owned;
  return field.role == Role::accumulated ? untouched.written : untouched.read;
}

template <int Dim>
void release_fields(Body<Dim>& body) {
  for (const Field<Dim>& field : body.fields()) {
    const Blocks untouched = untouched_of(body, field);
    if (field.block != nullptr) {
      give_back_blocks(body.*field.block, untouched);
    } else {
      release_table(body.*field.table, field.first, field.n_components, untouched);
    }
  }
}

template <int Dim>
void release_graph(Body<Dim>& body) {
  const Untouched& untouched = body.division->untouched;
  SweepGraph<Dim>& graph = body.graph;
  release_pairs(body);
  release_table(graph.X, 0, Dim, untouched.read);
  give_back_blocks(graph.inverse_Omega.data(), graph.inverse_Omega.size(), n_lanes,
                   untouched.owned);
  give_back_blocks(graph.Omega.data(), graph.Omega.size(), n_lanes, untouched.owned);
  if (!graph.C_sum.empty()) give_back_blocks(graph.C_sum, untouched.owned);
  if (!body.bulk) give_back_blocks(body.X.data(), std::ssize(body.X), n_lanes, untouched.owned);
}

#define DIPTYCH_INSTANTIATE(Dim)                                     \
  template Blocks untouched_of(const Body<Dim>&, const Field<Dim>&); \
  template void release_fields(Body<Dim>&);                          \
  template void release_graph(Body<Dim>&);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
