#include "meshes/block_kinks.hpp"

#include <algorithm>

namespace diptych::meshes {

namespace {

/// Sum over the nodes of a layer, and of how many.
struct Sum {
  double squares = 0;
  double n = 0;
};

/// Difference of even order `order` at a place along d, over the spacing there.
double squared_difference(
    const Mesh& mesh, const LatticeBlock& block, const std::array<int, 3>& at, int d, int order) {
  constexpr double binomial[2][5] = {{0, 1, -2, 1, 0}, {1, -4, 6, -4, 1}};
  const auto X = [&](int i) -> const Vec3& {
    auto place = at;
    place[d] += i;
    return mesh.nodes[block.node[static_cast<size_t>(block.index(place))]];
  };
  Vec3 difference = Vec3::Zero();
  for (int i = -order / 2; i <= order / 2; ++i)
    difference += binomial[order / 2 - 1][i + 2] * X(i);
  return 2 * difference.squaredNorm() /
         ((X(1) - X(0)).squaredNorm() + (X(0) - X(-1)).squaredNorm());
}

/// Of every layer across direction d. [n_nodes[d]]; n = 0 where the differences leave the block
std::vector<Sum> layers(const Mesh& mesh, const LatticeBlock& block, int d, int order) {
  std::vector<Sum> sums(static_cast<size_t>(block.n_nodes[d]));
  for (std::int64_t p = 0; p < block.n_places(); ++p) {
    const auto at = block.place(p);
    const bool is_in = at[d] >= order / 2 && at[d] < block.n_nodes[d] - order / 2;
    if (!is_in && !(block.is_closed[d] && block.n_nodes[d] > order)) continue;
    sums[static_cast<size_t>(at[d])].squares += squared_difference(mesh, block, at, d, order);
    sums[static_cast<size_t>(at[d])].n += 1;
  }
  return sums;
}

bool is_kink(const std::vector<Sum>& sums, int i, bool is_closed) {
  constexpr double above = 16, least = 0.02;
  const auto n = static_cast<int>(sums.size());
  const Sum& own = sums[static_cast<size_t>(i)];
  if (own.n == 0 || own.squares <= least * least * own.n) return false;
  for (const int step : {-1, 1}) {
    const int j = is_closed ? (i + step + n) % n : i + step;
    if (j < 0 || j >= n || sums[static_cast<size_t>(j)].n == 0) return false;
    if (own.squares <= above * sums[static_cast<size_t>(j)].squares) return false;
  }
  return true;
}

}  // namespace

std::vector<CellPair> cells_at_kinks(const Mesh& mesh, const LatticeBlock& block) {
  std::vector<CellPair> pairs;
  for (int d = 0; d < block.dimension; ++d) {
    const std::vector<Sum> sums = layers(mesh, block, d, 2);
    for (int i = 0; i < block.n_nodes[d]; ++i) {
      if (!is_kink(sums, i, block.is_closed[d])) continue;
      std::array<int, 3> before{0, 0, 0}, after{0, 0, 0};
      after[d] = i;
      before[d] = (i + block.n_cells[d] - 1) % block.n_cells[d];
      pairs.emplace_back(block.cell_at(before), block.cell_at(after));
    }
  }
  return pairs;
}

bool is_smooth(const Mesh& mesh, const std::vector<LatticeBlock>& blocks) {
  constexpr double rough = 2, smallest = 1e-3;
  Sum second, fourth;
  std::int64_t n_cells = 0, n_fit = 0;
  for (const LatticeBlock& block : blocks) {
    int n_thin = 0;
    for (int d = 0; d < block.dimension; ++d) {
      n_thin += block.n_nodes[d] < 3 ? 1 : 0;
      const std::vector<Sum> of_second = layers(mesh, block, d, 2),
                             of_fourth = layers(mesh, block, d, 4);
      for (size_t i = 0; i < of_fourth.size(); ++i) {
        if (of_fourth[i].n == 0) continue;
        second.squares += of_second[i].squares;
        fourth.squares += of_fourth[i].squares;
        fourth.n += of_fourth[i].n;
      }
    }
    n_cells += std::ssize(block.cell);
    n_fit += n_thin <= 1 ? std::ssize(block.cell) : 0;
  }
  const bool is_even = fourth.squares <= smallest * smallest * fourth.n ||
                       fourth.squares <= rough * rough * second.squares;
  return n_cells > 0 && 2 * n_fit >= n_cells && is_even;
}

}  // namespace diptych::meshes
