#include "fvm/sbp_blocks_graph.hpp"

#include "common/closure/closure_repair.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "fvm/block_metrics.hpp"
#include "fvm/block_sides.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace diptych::fvm {

namespace {

using algebra::Vec3;
using meshes::LatticeBlock;

struct Entry {
  std::int32_t node;
  Vec3 C;
};
using Rows = std::vector<std::vector<Entry>>;

void add_pairs(const BlockMetrics& metrics, Rows& rows) {
  const LatticeBlock& block = metrics.block();
  for (std::int64_t p = 0; p < block.n_places(); ++p) {
    const auto place = block.place(p);
    for (int d = 0; d < block.dimension; ++d) {
      const Vec3 M = metrics.area(p, d);
      auto at = place;
      for (const closure::SbpOperator::Entry& entry : metrics.along(d).row(place[d])) {
        at[d] = entry.node;
        const auto b = block.node[static_cast<size_t>(block.index(at))];
        rows[static_cast<size_t>(block.node[static_cast<size_t>(p)])].push_back(
            {b, 2 * entry.Q * M});
      }
    }
  }
}

/// Adds up entries with the same neighbour, which blocks side by side have along what they share.
void finish_rows(Rows& rows, scheme::PairGraph& graph) {
  graph.row.assign(1, 0);
  std::vector<algebra::Vec3> areas;
  for (auto& row : rows) {
    std::stable_sort(row.begin(), row.end(),
                     [](const Entry& p, const Entry& q) { return p.node < q.node; });
    for (const auto& [b, C] : row) {
      if (graph.n_pairs() > graph.row.back() && graph.neighbour.back() == b) {
        areas.back() += C;
      } else {
        graph.neighbour.push_back(b);
        areas.push_back(C);
      }
    }
    graph.row.push_back(graph.n_pairs());
    row = {};
  }
  graph.C = algebra::SharedVectors(std::move(areas));
}

constexpr int highest_order = 4;

/// The order on the lines of a direction, and how many nodes they have.
struct Line {
  int n_nodes = 0, order = 2;
  bool is_closed = false;
};

std::vector<Line> lines_of(const std::vector<LatticeBlock>& blocks, int order) {
  std::vector<Line> lines;
  for (const LatticeBlock& block : blocks) {
    for (int d = 0; d < block.dimension; ++d) {
      const int n = block.n_nodes[d];
      const closure::SbpTable& table = block.is_closed[d] ? closure::widest_closed_table(order, n)
                                                          : closure::widest_sbp_table(order, n);
      lines.push_back({n, table.order, block.is_closed[d]});
    }
  }
  return lines;
}

}  // namespace

std::vector<LatticeBlock> smooth_blocks(const meshes::Mesh& mesh) {
  std::vector<LatticeBlock> blocks = meshes::lattice_blocks(mesh);
  if (!meshes::is_smooth(mesh, blocks)) blocks.clear();
  return blocks;
}

scheme::PairGraph sbp_blocks_graph(const meshes::Mesh& mesh,
                                   const std::vector<LatticeBlock>& blocks,
                                   int order) {
  order = std::min(order, highest_order);
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  graph.Omega.assign(mesh.nodes.size(), 0.0);
  BlockSides sides(mesh);
  Rows rows(mesh.nodes.size());
  for (const LatticeBlock& block : blocks) {
    const BlockMetrics metrics(mesh, block, order);
    for (std::int64_t p = 0; p < block.n_places(); ++p)
      graph.Omega[block.node[static_cast<size_t>(p)]] += metrics.volume(p);
    add_pairs(metrics, rows);
    sides.add(metrics);
  }
  finish_rows(rows, graph);
  sides.finish(graph);
  link_reverse_pairs(graph);
  std::vector<double> k(graph.C.size());
  for (size_t p = 0; p < k.size(); ++p)
    k[p] = 0.5 * (graph.C[p].norm() + graph.C[graph.reverse(p)].norm());
  closure::repair_closure_pairs(graph, k);
  set_classes(graph);
  validate(graph);
  return graph;
}

std::string blocks_text(const std::vector<LatticeBlock>& blocks, int order) {
  std::map<int, std::pair<int, int>> of_order;  // fewest and most nodes
  int n_closed = 0;
  for (const Line& line : lines_of(blocks, std::min(order, highest_order))) {
    auto& [least, most] =
        of_order.try_emplace(-line.order, line.n_nodes, line.n_nodes).first->second;
    least = std::min(least, line.n_nodes);
    most = std::max(most, line.n_nodes);
    n_closed += line.is_closed ? 1 : 0;
  }
  std::string text = blocks.size() == 1
                         ? std::string("sbp: one curved block")
                         : fmt::format("sbp: {} blocks glued at their nodes", blocks.size());
  for (const auto& [minus_order, nodes] : of_order) {
    const auto& [least, most] = nodes;
    text += fmt::format(
        ", order {} on lines of {} nodes", -minus_order,
        least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most));
  }
  if (n_closed > 0) text += ", some of them rings";
  return text;
}

bool is_too_small(const std::vector<LatticeBlock>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [](const LatticeBlock& block) {
    int n_short = 0;
    for (int d = 0; d < block.dimension; ++d)
      n_short += block.n_nodes[d] <= 3 ? 1 : 0;
    return n_short > 1;
  });
}

bool has_lines_of_two(const std::vector<LatticeBlock>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [](const LatticeBlock& block) {
    const auto end = block.n_nodes.begin() + block.dimension;
    return std::find(block.n_nodes.begin(), end, 2) != end;
  });
}

double unevenness_of_short_lines(const meshes::Mesh& mesh,
                                 const std::vector<LatticeBlock>& blocks) {
  const int enough = closure::sbp_table(highest_order).least_nodes();
  double most = 0;  // mean square of logarithms
  for (const LatticeBlock& block : blocks) {
    for (int d = 0; d < block.dimension; ++d) {
      const int n = block.n_nodes[d];
      if (block.is_closed[d] || n < 3 || n >= enough) continue;
      double sum = 0;
      std::int64_t n_summed = 0;
      for (std::int64_t p = 0; p < block.n_places(); ++p) {
        auto at = block.place(p);
        if (at[d] == 0 || at[d] == n - 1) continue;
        const auto X = [&](int step) -> const Vec3& {
          auto there = at;
          there[d] += step;
          return mesh.nodes[block.node[static_cast<size_t>(block.index(there))]];
        };
        const double ratio = std::log((X(1) - X(0)).norm() / (X(0) - X(-1)).norm());
        sum += ratio * ratio;
        ++n_summed;
      }
      most = std::max(most, sum / static_cast<double>(n_summed));
    }
  }
  return std::exp(std::sqrt(most));
}

bool gives_energy(const std::vector<LatticeBlock>& blocks, int order) {
  const int most = std::min(order, highest_order);
  if (most == 2) return false;
  const std::vector<Line> lines = lines_of(blocks, most);
  return std::any_of(lines.begin(), lines.end(),
                     [](const Line& line) { return line.n_nodes == 6 && !line.is_closed; });
}

std::vector<std::string> blocks_notices(const std::vector<LatticeBlock>& blocks, int order) {
  std::vector<std::string> texts;
  if (order > highest_order) {
    texts.push_back(
        fmt::format("order {} instead of {}: curved blocks have no slopes along lines, "
                    "without which D_ab of order {} gives energy",
                    highest_order, order, order));
  }
  const int most = std::min(order, highest_order);
  std::map<std::pair<int, bool>, Line> lost;
  for (const Line& line : lines_of(blocks, most)) {
    if (line.order != most) lost[{line.n_nodes, line.is_closed}] = line;
  }
  for (const auto& [key, line] : lost) {
    texts.push_back(
        fmt::format("order {} instead of {} on {} of {} nodes, order {} takes {}", line.order, most,
                    line.is_closed ? "rings" : "lines", line.n_nodes, most,
                    line.is_closed ? 2 * std::ssize(closure::sbp_table(most).interior) + 1
                                   : closure::sbp_table(most).least_nodes()));
  }
  return texts;
}

}  // namespace diptych::fvm
