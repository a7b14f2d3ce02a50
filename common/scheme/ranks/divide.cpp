#include "common/parallel/partition.hpp"
#include "common/parallel/sharing.hpp"
#include "common/scheme/body/node_chunks.hpp"
#include "common/scheme/ranks/division.hpp"

#include <algorithm>
#include <map>

namespace diptych::scheme {

namespace {

using algebra::n_lanes;

/// use(a, b): node a, or its lane, reads node b in a sweep over pairs. In runs all lanes of a block
/// read, those without a pair too.
template <int Dim, class Use>
void for_reads(const SweepGraph<Dim>& graph, const Use& use) {
  const bool has_slopes = !graph.slopes.empty();
  if (graph.shape.arrangement == Arrangement::rows) {
    const auto for_rows = [&](const auto& of) {
      for (std::int64_t a = 0; a < graph.n_nodes; ++a) {
        for (std::int64_t chunk = of.row[a]; chunk < of.row[a + 1]; ++chunk) {
          for (const std::int32_t b : of.neighbours[chunk].node)
            use(a, static_cast<std::int64_t>(b));
        }
      }
    };
    for_rows(graph);
    if (has_slopes) for_rows(graph.slopes);
    return;
  }
  const auto for_lanes = [&](std::int64_t block, std::int64_t offset, const auto& both) {
    for (std::int64_t a = block * n_lanes; a < (block + 1) * n_lanes; ++a) {
      const std::int64_t b = a + offset;
      if (a < graph.n_nodes && b >= 0 && b < graph.n_nodes) both(a, b);
    }
  };
  for (std::int64_t block = 0; block < graph.n_blocks; ++block) {
    for (std::int64_t chunk = graph.row[block]; chunk < graph.row[block + 1]; ++chunk)
      for_lanes(block, graph.offset[chunk], use);
    for (std::int64_t chunk = has_slopes ? graph.slopes.row[block] : 0;
         has_slopes && chunk < graph.slopes.row[block + 1]; ++chunk)
      for_lanes(block, graph.slopes.offset[chunk], use);
    for (std::int64_t chunk = graph.mutual.row[block]; chunk < graph.mutual.row[block + 1];
         ++chunk) {
      for_lanes(block, graph.mutual.offset[chunk], [&](std::int64_t a, std::int64_t b) {
        use(a, b);
        use(b, a);
      });
    }
  }
}

template <int Dim>
parallel::ChunkGraph chunk_graph(const Body<Dim>& body) {
  const std::int64_t n_chunks = parallel::n_chunks_of(body.n_blocks);
  parallel::ChunkGraph graph;
  graph.work.assign(static_cast<size_t>(n_chunks), 0);
  graph.centre.assign(static_cast<size_t>(n_chunks), {0, 0, 0});
  std::vector<std::map<std::int32_t, std::int64_t>> pairs(graph.work.size());
  const auto add = [&](std::int64_t c, std::int64_t d) {
    if (c != d) ++pairs[c][static_cast<std::int32_t>(d)];
  };
  for_reads(body.graph, [&](std::int64_t a, std::int64_t b) {
    ++graph.work[chunk_of_node(a)];
    add(chunk_of_node(a), chunk_of_node(b));
    add(chunk_of_node(b), chunk_of_node(a));
  });
  for (std::int64_t a = 0; a < body.n_owned; ++a) {
    constexpr std::int64_t work_of_node = 8;  // relaxation, stress, update, in pairs
    const std::int64_t c = chunk_of_node(a);
    const auto n = static_cast<double>(std::min(body.n_owned - c * chunk_nodes, chunk_nodes));
    graph.work[c] += work_of_node;
    for (int i = 0; i < 3; ++i)
      graph.centre[c][i] += body.X[a][i] / n;
  }
  graph.row.push_back(0);
  for (const auto& row : pairs) {
    for (const auto& [other, n] : row) {
      graph.neighbour.push_back(other);
      graph.weight.push_back(n);
    }
    graph.row.push_back(std::ssize(graph.neighbour));
  }
  return graph;
}

/// The owners of chunks and how well they share the work, as rank 0 finds them. Where there are
/// more ranks than chunks the last ranks have none, and nothing to work.
template <int Dim>
std::vector<int> owners_of(const Body<Dim>& body,
                           parallel::Communicator& ranks,
                           const std::string& partition,
                           double& imbalance) {
  std::vector<int> owner;
  if (ranks.rank() == 0) {
    const parallel::ChunkGraph graph = chunk_graph(body);
    const auto n_parts = std::min<std::int64_t>(ranks.size(), std::ssize(graph.work));
    owner = parallel::partitioners().at(partition)(graph, static_cast<int>(n_parts));
    imbalance = parallel::imbalance(graph, owner, ranks.size());
  }
  parallel::share(ranks, owner);
  parallel::share(ranks, imbalance);
  return owner;
}

/// Fills inner and outer.
/// @return [n_nodes] 1 where a sweep of this rank reads a node
template <int Dim>
std::vector<char> share_chunks(const Body<Dim>& body, Division& division) {
  const parallel::Part& part = division.part;
  std::vector<char> needed(static_cast<size_t>(body.n_owned)),
      reads_others(static_cast<size_t>(parallel::n_chunks_of(body.n_blocks)));
  for_reads(body.graph, [&](std::int64_t a, std::int64_t b) {
    const std::int64_t chunk = chunk_of_node(a);
    if (!part.owns(chunk)) return;
    needed[b] = 1;
    if (!part.owns(chunk_of_node(b))) reads_others[chunk] = 1;
  });
  for (const std::int64_t chunk : part.own_chunks())
    (reads_others[chunk] != 0 ? division.outer : division.inner).push_back(chunk);
  return needed;
}

template <int Dim>
Untouched untouched_by(const Body<Dim>& body, const Division& division) {
  const auto n_chunks = static_cast<size_t>(parallel::n_chunks_of(body.n_blocks));
  std::vector<char> owned(n_chunks), read(n_chunks), written(n_chunks), worked(n_chunks);
  for (const std::int64_t chunk : division.part.own_chunks())
    owned[chunk] = 1;
  for (const parallel::NodeRange& nodes : division.pairs.received()) {
    for (std::int64_t a = nodes.begin; a < nodes.end; ++a)
      read[chunk_of_node(a)] = 1;
  }
  for (const std::int64_t chunk : division.runs.written)
    written[chunk] = 1;
  for (const auto* segments : {&division.runs.even, &division.runs.odd}) {
    for (const RankSegment& segment : *segments) {
      for (const std::int32_t chunk : segment.forces)
        worked[chunk] = 1;
    }
  }
  return untouched_of(body.n_blocks, owned, read, written, worked);
}

}  // namespace

template <int Dim>
void divide(Body<Dim>& body, parallel::Communicator& ranks, const std::string& partition) {
  auto division = std::make_shared<Division>();
  const std::vector<int> owner = owners_of(body, ranks, partition, division->imbalance);
  division->part = parallel::Part(ranks, owner);
  const parallel::Part& part = division->part;
  const auto owner_of_node = [&](std::int64_t a) { return owner[chunk_of_node(a)]; };
  division->pairs = parallel::Halo(ranks, share_chunks(body, *division), owner_of_node);
  if (body.in_runs()) {
    const MutualPairs<Dim>& mutual = body.graph.mutual;
    std::vector<std::int64_t> sent;
    for (const parallel::NodeRange& nodes : division->pairs.sent()) {
      for (std::int64_t c = chunk_of_node(nodes.begin); c <= chunk_of_node(nodes.end - 1); ++c)
        sent.push_back(c);
    }
    division->runs = run_work({mutual.row.data(), static_cast<size_t>(mutual.row.size())},
                              {mutual.offset.data(), static_cast<size_t>(mutual.offset.size())},
                              mutual.order, part, division->outer, sent);
  }
  if (body.bulk) {
    std::vector<char> corners(static_cast<size_t>(body.n_owned));
    division->cells = body.bulk->work_of(part, corners);
    division->corners = parallel::Halo(ranks, corners, owner_of_node);
  }
  division->untouched = untouched_by(body, *division);
  body.division = std::move(division);
}

template void divide(Body<2>&, parallel::Communicator&, const std::string&);
template void divide(Body<3>&, parallel::Communicator&, const std::string&);

}  // namespace diptych::scheme
