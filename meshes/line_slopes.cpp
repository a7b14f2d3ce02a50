#include "meshes/line_slopes.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace diptych::meshes {

namespace {

/// Of the differences d_j from `first` on, in eighths.
struct Weights {
  int first;
  std::vector<double> eighths;
};

/// Of node i <= (n - 1)/2.
Weights of_near_half(int i, int n) {
  if (n == 2 || (n == 3 && i == 0)) return {0, {8}};
  if (n == 3) return {0, {4, 4}};
  if (i == 0) return {0, {12, -4}};
  if (i == 1) return {0, {3, 6, -1}};
  return {i - 2, {-1, 5, 5, -1}};
}

}  // namespace

std::vector<std::pair<int, double>> line_slope(int i, int n) {
  const bool is_far = i > n - 1 - i;
  const int near = is_far ? n - 1 - i : i;
  const Weights weights = of_near_half(near, n);
  std::vector<double> of_node(static_cast<size_t>(n));
  for (size_t k = 0; k < weights.eighths.size(); ++k) {
    const size_t j = static_cast<size_t>(weights.first) + k;
    of_node[j + 1] += weights.eighths[k] / 8;
    of_node[j] -= weights.eighths[k] / 8;
  }
  std::vector<std::pair<int, double>> slope;
  for (int j = 0; j < n; ++j) {
    if (j == near || of_node[static_cast<size_t>(j)] == 0) continue;
    // seen from the other end places turn round, and with them the sign of differences
    slope.emplace_back(is_far ? n - 1 - j : j, (is_far ? -1 : 1) * of_node[static_cast<size_t>(j)]);
  }
  return slope;
}

LineSlopes line_slopes(const StructuredBlock& block, const Mat3& edges) {
  const Mat3 dual = edges.inverse().transpose();  // columns g_d with g_d . e_k = delta_dk
  std::array<std::vector<std::vector<std::pair<int, double>>>, 3> of_line;
  for (int d = 0; d < block.dimension; ++d) {
    for (int i = 0; i < block.n_nodes[d]; ++i)
      of_line[d].push_back(line_slope(i, block.n_nodes[d]));
  }
  LineSlopes slopes;
  slopes.row.push_back(0);
  std::vector<std::pair<std::int32_t, algebra::Vec3>> row;
  for (const auto& place : block.place) {
    row.clear();
    for (int d = 0; d < block.dimension; ++d) {
      auto at = place;
      for (const auto& [node, weight] : of_line[d][static_cast<size_t>(place[d])]) {
        at[d] = node;
        row.emplace_back(block.node_at(at), weight * dual.col(d));
      }
    }
    std::sort(row.begin(), row.end(),
              [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [b, weight] : row) {
      slopes.neighbour.push_back(b);
      slopes.weight.push_back(weight);
    }
    slopes.row.push_back(static_cast<std::int64_t>(slopes.neighbour.size()));
  }
  return slopes;
}

}  // namespace diptych::meshes
