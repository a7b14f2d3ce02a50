#include "benchmarks/cost/local_steps.hpp"

#include "benchmarks/terminal/text.hpp"
#include "common/scheme/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

constexpr size_t shown_levels = 5;  // the last of them with all beyond

/// Levels by the rates alone.
std::vector<int> levels_of(const std::vector<double>& rates, int most_levels) {
  const double largest = *std::max_element(rates.begin(), rates.end());
  std::vector<int> levels;
  levels.reserve(rates.size());
  for (const double rate : rates)
    levels.push_back(std::min(most_levels - 1, std::ilogb(largest / rate)));
  return levels;
}

/// Lowers them until those of neighbours differ by no more than one: level by level, each step out
/// of what is below.
void lower(const scheme::PairGraph& graph, int most_levels, std::vector<int>& levels) {
  for (int level = 0; level + 1 < most_levels; ++level) {
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      if (levels[a] != level) continue;
      for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
        int& of_neighbour = levels[graph.neighbour[k]];
        of_neighbour = std::min(of_neighbour, level + 1);
      }
    }
  }
}

/// Of a level and, in the last that is shown, all beyond.
double shown_share(const LocalSteps& row, size_t level) {
  if (level + 1 < shown_levels) return level < row.shares.size() ? row.shares[level] : 0;
  double sum = 0;
  for (size_t k = level; k < row.shares.size(); ++k)
    sum += row.shares[k];
  return sum;
}

}  // namespace

LocalSteps local_steps(const scheme::PairGraph& graph, int most_levels) {
  const std::vector<double> rates = scheme::geometric_rates(graph);
  std::vector<int> levels = levels_of(rates, most_levels);
  lower(graph, most_levels, levels);
  LocalSteps steps;
  steps.nodes = graph.n_nodes();
  const auto [least, most] = std::minmax_element(rates.begin(), rates.end());
  steps.rate_ratio = *most / *least;
  double node_work = 0, pair_work = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const auto level = static_cast<size_t>(levels[a]);
    if (level >= steps.shares.size()) steps.shares.resize(level + 1, 0.0);
    steps.shares[level] += 1.0 / static_cast<double>(graph.n_nodes());
    node_work += std::ldexp(1.0, -levels[a]);
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k)
      pair_work += std::ldexp(1.0, -std::min(levels[a], levels[graph.neighbour[k]]));
  }
  steps.of_nodes = static_cast<double>(graph.n_nodes()) / node_work;
  steps.of_pairs = static_cast<double>(graph.neighbour.size()) / pair_work;
  return steps;
}

std::string local_steps_table(const std::vector<LocalSteps>& rows) {
  size_t width = 7;
  for (const LocalSteps& row : rows)
    width = std::max(width, row.variant.size());
  std::string head =
      fmt::format("{:<{}}  {:<6}  {:>8}  {:>8}", "variant", width, "method", "nodes", "dt ratio");
  for (size_t level = 0; level < shown_levels; ++level)
    head += fmt::format("  {:>5}", level + 1 < shown_levels ? fmt::format("x{}", 1 << level)
                                                            : fmt::format("x{}+", 1 << level));
  head += fmt::format("  {:>5}  {:>5}", "pairs", "nodes");
  std::string text = head + "\n" + std::string(head.size(), '-') + "\n";
  for (const LocalSteps& row : rows) {
    text +=
        fmt::format("{:<{}}  {:<6}  {:>8}  {:>8.3g}", row.variant.empty() ? "as is" : row.variant,
                    width, row.method, row.nodes, row.rate_ratio);
    for (size_t level = 0; level < shown_levels; ++level)
      text += fmt::format("  {:>5.3f}", shown_share(row, level));
    text += fmt::format("  {:>5.2f}  {:>5.2f}\n", row.of_pairs, row.of_nodes);
  }
  return text;
}

std::string local_steps_csv(const std::vector<LocalSteps>& rows) {
  std::string csv =
      "variant,method,nodes,largest over smallest step [-],levels [-],nodes at the smallest step "
      "[-],ideal speed-up by pairs [-],ideal speed-up by nodes [-]\n";
  for (const LocalSteps& row : rows) {
    csv += fmt::format("{},{},{},{:.6g},{},{:.6g},{:.6g},{:.6g}\n", quoted(row.variant), row.method,
                       row.nodes, row.rate_ratio, row.shares.size(), row.shares.front(),
                       row.of_pairs, row.of_nodes);
  }
  return csv;
}

}  // namespace diptych::harness
