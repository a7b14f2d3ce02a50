#include "meshes/line_slopes.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace diptych::meshes {

namespace {

/// Coefficients of the differences d_j of a line.
using Differences = std::vector<double>;

/// Nodes from an end whose slopes follow from those farther inside, and pairs whose areas may
/// differ.
constexpr int ends = 3;
/// Areas that differ by less are the same.
constexpr double same = 1e-10;

/// As where all areas are the same: node i <= (n - 1)/2 of n.
Differences plain_slope(int i, int n) {
  Differences slope(static_cast<size_t>(n - 1), 0.0);
  const auto set = [&](int first, std::initializer_list<double> eighths) {
    for (const double value : eighths)
      slope[static_cast<size_t>(first++)] = value / 8;
  };
  if (n == 2 || (n == 3 && i == 0)) {
    set(0, {8});
  } else if (n == 3) {
    set(0, {4, 4});
  } else if (i == 0) {
    set(0, {12, -4});
  } else if (i == 1) {
    set(0, {3, 6, -1});
  } else {
    set(i - 2, {-1, 5, 5, -1});
  }
  return slope;
}

/// Of pair i, where all areas are the same: D^T D d/16.
Differences plain_jump(int i, int n) {
  Differences jump(static_cast<size_t>(n - 1), 0.0);
  const auto add = [&](const std::vector<double>& difference, int first, double factor) {
    const int k = i - first;
    if (first < 0 || first + std::ssize(difference) > n - 1 || k < 0 || k >= std::ssize(difference))
      return;
    for (size_t j = 0; j < difference.size(); ++j)
      jump[static_cast<size_t>(first) + j] +=
          factor * difference[static_cast<size_t>(k)] * difference[j];
  };
  for (int first = i - 2; first <= i; ++first) {
    if (n > 3) add({1, -2, 1}, first, 1.0 / 16);
    if (n == 3) add({1, -1}, first, 1.0 / 4);
  }
  return jump;
}

Differences mirrored(Differences slope) {
  std::reverse(slope.begin(), slope.end());
  return slope;
}

SlopeRow row_of(const Differences& slope, int i) {
  const auto n = static_cast<int>(slope.size()) + 1;
  SlopeRow row;
  for (int j = 0; j < n; ++j) {
    const double before = j > 0 ? slope[static_cast<size_t>(j) - 1] : 0,
                 after = j < n - 1 ? slope[static_cast<size_t>(j)] : 0;
    if (j != i && std::abs(before - after) > same) row.emplace_back(j, before - after);
  }
  return row;
}

}  // namespace

std::vector<SlopeRow> slopes_of_line(const std::vector<double>& area) {
  const auto n = static_cast<int>(area.size()) + 1;
  const double middle = area[area.size() / 2];
  std::vector<Differences> slope(static_cast<size_t>(n));
  const int inner = std::min(ends, (n - 1) / 2);
  for (int i = inner; i <= n - 1 - inner; ++i) {
    const bool is_far = i > n - 1 - i;
    slope[static_cast<size_t>(i)] =
        is_far ? mirrored(plain_slope(n - 1 - i, n)) : plain_slope(i, n);
  }
  // 1/2 (G_i + G_{i+1}) = d_i - jump_i, from the inside to both ends
  const auto follow = [&](int i, int from, int pair) {
    const Differences jump = plain_jump(pair, n);
    const double ratio = middle / area[static_cast<size_t>(pair)];
    Differences& next = slope[static_cast<size_t>(i)];
    next.resize(area.size());
    for (size_t j = 0; j < next.size(); ++j)
      next[j] = -2 * ratio * jump[j] - slope[static_cast<size_t>(from)][j];
    next[static_cast<size_t>(pair)] += 2;
  };
  for (int i = inner - 1; i >= 0; --i) {
    follow(i, i + 1, i);
    follow(n - 1 - i, n - 2 - i, n - 2 - i);
  }
  std::vector<SlopeRow> rows;
  for (int i = 0; i < n; ++i)
    rows.push_back(row_of(slope[static_cast<size_t>(i)], i));
  return rows;
}

namespace {

/// Slopes of the nodes of lines with the same areas, whose weights stand once for each direction.
class LineRows {
 public:
  /// One pair of a node of a line.
  struct Pair {
    int place;
    std::uint32_t weight;  ///< among those of all lines
  };

  explicit LineRows(std::vector<SlopeRow> rows) : rows_(std::move(rows)) {}

  /// Puts the weights of direction d behind the others, unless they are there already.
  void add_weights(int d, const Vec3& dual, std::vector<Vec3>& weights) {
    auto& along = along_[static_cast<size_t>(d)];
    if (!along.empty()) return;
    for (const SlopeRow& row : rows_) {
      along.emplace_back();
      for (const auto& [place, weight] : row) {
        along.back().push_back({place, static_cast<std::uint32_t>(weights.size())});
        weights.emplace_back(weight * dual);
      }
    }
  }
  const std::vector<Pair>& row(int d, int i) const {
    return along_[static_cast<size_t>(d)][static_cast<size_t>(i)];
  }

 private:
  std::vector<SlopeRow> rows_;
  std::array<std::vector<std::vector<Pair>>, 3> along_;  ///< [direction][node of the line]
};

}  // namespace

LineSlopes line_slopes(const StructuredBlock& block,
                       const Mat3& edges,
                       const std::function<double(std::int32_t, std::int32_t)>& area) {
  const Mat3 dual = edges.inverse().transpose();        // columns g_d with g_d . e_k = delta_dk
  std::map<std::vector<std::int64_t>, LineRows> known;  // lines with such areas
  using Row = std::vector<LineRows::Pair>;
  std::vector<std::array<const Row*, 3>> of_node(block.place.size(), {nullptr, nullptr, nullptr});
  std::vector<Vec3> weights;
  for (int d = 0; d < block.dimension; ++d) {
    const int n = block.n_nodes[d];
    for (const auto& place : block.place) {
      if (place[d] != 0 || n < 2) continue;
      const auto node = [&](int i) {
        auto at = place;
        at[d] = i;
        return block.node_at(at);
      };
      const int middle = (n - 1) / 2;
      std::vector<double> areas(static_cast<size_t>(n) - 1, area(node(middle), node(middle + 1)));
      std::vector<std::int64_t> key{n};
      for (int k = 0; k < n - 1; ++k) {
        if (k >= ends && k < n - 1 - ends) continue;
        const double ratio = area(node(k), node(k + 1)) / areas[static_cast<size_t>(middle)];
        areas[static_cast<size_t>(k)] *= k == middle ? 1 : ratio;
        key.push_back(std::llround(ratio / same));
      }
      auto found = known.find(key);
      if (found == known.end()) found = known.emplace(key, LineRows(slopes_of_line(areas))).first;
      found->second.add_weights(d, dual.col(d), weights);
      for (int i = 0; i < n; ++i)
        of_node[static_cast<size_t>(node(i))][d] = &found->second.row(d, i);
    }
  }
  LineSlopes slopes;
  slopes.row.reserve(of_node.size() + 1);
  slopes.row.push_back(0);
  for (const auto& of_lines : of_node) {
    std::int64_t n = 0;
    for (const Row* row : of_lines)
      n += row == nullptr ? 0 : std::ssize(*row);
    slopes.row.push_back(slopes.row.back() + n);
  }
  slopes.neighbour.resize(static_cast<size_t>(slopes.row.back()));
  algebra::SharedVectors::Numbers number(slopes.neighbour.size());
  parallel::for_chunks(std::ssize(of_node), [&](auto begin, auto end, auto) {
    std::vector<std::pair<std::int32_t, std::uint32_t>> row;
    for (std::int64_t a = begin; a < end; ++a) {
      row.clear();
      for (int d = 0; d < block.dimension; ++d) {
        if (of_node[a][d] == nullptr) continue;
        auto at = block.place[a];
        for (const auto& [j, weight] : *of_node[a][d]) {
          at[d] = j;
          row.emplace_back(block.node_at(at), weight);
        }
      }
      std::sort(row.begin(), row.end(),
                [](const auto& p, const auto& q) { return p.first < q.first; });
      for (size_t k = 0; k < row.size(); ++k)
        std::tie(slopes.neighbour[slopes.row[a] + k], number[slopes.row[a] + k]) = row[k];
    }
  });
  slopes.weight = algebra::SharedVectors(std::move(weights), std::move(number));
  return slopes;
}

}  // namespace diptych::meshes
