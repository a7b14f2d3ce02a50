/// Slopes along lines (meshes/line_slopes.hpp), what they leave of jumps, and their graph in both
/// arrangements.

#include "meshes/line_slopes.hpp"

#include "common/closure/sbp_operator.hpp"
#include "common/scheme/graph/slope_graph.hpp"
#include "common/scheme/sweeps/strain_sum.hpp"
#include "meshes/generators.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

namespace diptych::graphs {
namespace {

using Matrix = Eigen::MatrixXd;

/// G_i = sum_j row(i, j) v_j on a line with a spacing of one.
Matrix slopes_of(const std::vector<double>& area) {
  const auto n = static_cast<int>(area.size()) + 1;
  const auto rows = meshes::slopes_of_line(area);
  Matrix G = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    for (const auto& [j, weight] : rows[static_cast<size_t>(i)]) {
      G(i, j) += weight;
      G(i, i) -= weight;
    }
  }
  return G;
}

/// Jumps between neighbours, for each node of the line as a column.
Matrix jumps_of(const std::vector<double>& area) {
  const auto n = static_cast<int>(area.size()) + 1;
  const Matrix G = slopes_of(area);
  Matrix jumps = Matrix::Zero(n - 1, n);
  for (int i = 0; i + 1 < n; ++i) {
    jumps(i, i + 1) += 1;
    jumps(i, i) -= 1;
    jumps.row(i) -= 0.5 * (G.row(i) + G.row(i + 1));
  }
  return jumps;
}

Matrix jumps_of_line(int n) {
  return jumps_of(std::vector<double>(static_cast<size_t>(n) - 1, 0.7));
}

Eigen::VectorXd powers(int n, int k) {
  Eigen::VectorXd x(n);
  for (int i = 0; i < n; ++i)
    x[i] = std::pow(i - 0.3 * n, k);
  return x;
}

// 1/16 of D^T D d with the second differences D of the differences d; of three nodes a quarter with
// first ones, of two nothing is left.
TEST(LineSlopes, LeaveJumpsThatAreSumsOfSquares) {
  for (const int n : {2, 3, 4, 5, 6, 7, 8, 12}) {
    Matrix d = Matrix::Zero(n - 1, n);
    for (int i = 0; i + 1 < n; ++i) {
      d(i, i) = -1;
      d(i, i + 1) = 1;
    }
    Matrix D = n == 3 ? Matrix(1, 2) : Matrix::Zero(std::max(0, n - 3), n - 1);
    if (n == 3) D << 1, -1;
    for (int i = 0; i + 3 < n; ++i)
      D.row(i).segment(i, 3) << 1, -2, 1;
    const Matrix wanted = (n == 3 ? 0.25 : 1.0 / 16) * D.transpose() * D * d;
    EXPECT_LT((jumps_of_line(n) - wanted).cwiseAbs().maxCoeff(), 1e-14) << n;
  }
}

TEST(LineSlopes, VanishForPolynomials) {
  const int n = 12;
  for (int k = 0; k <= 4; ++k) {
    const Eigen::VectorXd jumps = jumps_of_line(n) * powers(n, k);
    const Eigen::VectorXd inside = jumps.segment(2, n - 5);
    EXPECT_LT(inside.cwiseAbs().maxCoeff(), 1e-9) << k;
    if (k <= 2) {
      EXPECT_LT(jumps.cwiseAbs().maxCoeff(), 1e-12) << k;
    }
  }
  EXPECT_GT((jumps_of_line(n) * powers(n, 5)).segment(2, n - 5).cwiseAbs().minCoeff(), 1);
}

TEST(LineSlopes, LeaveTheShortestWavesAsTheyAre) {
  const int n = 12;
  Eigen::VectorXd v(n);
  for (int i = 0; i < n; ++i)
    v[i] = i % 2 == 0 ? 1 : -1;
  const Eigen::VectorXd jumps = jumps_of_line(n) * v;
  for (int i = 2; i + 3 < n; ++i)
    EXPECT_NEAR(jumps[i], v[i + 1] - v[i], 1e-14);
}

/// Least eigenvalue of the symmetric part of what D_ab takes on a line whose pairs have the areas
/// of an operator, per c/h.
double least_damping(const closure::SbpTable& table, int n) {
  const closure::SbpOperator line(table, n);
  std::vector<double> area;
  for (int i = 0; i + 1 < n; ++i) {
    for (const auto& entry : line.row(i))
      if (entry.node == i + 1) area.push_back(entry.Q);
  }
  const Matrix jumps = jumps_of(area);
  Matrix A = Matrix::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    for (const auto& entry : line.row(i)) {
      if (entry.node != i + 1) continue;
      A.row(i + 1) += entry.Q * jumps.row(i);
      A.row(i) -= entry.Q * jumps.row(i);
    }
  }
  Matrix scaled = 0.5 * (A + A.transpose());
  for (int i = 0; i < n; ++i) {
    scaled.row(i) /= std::sqrt(line.H(i));
    scaled.col(i) /= std::sqrt(line.H(i));
  }
  return Eigen::SelfAdjointEigenSolver<Matrix>(scaled).eigenvalues()[0];
}

// Order 6 has other areas farther from the ends than slopes make up for.
TEST(LineSlopes, TakeEnergyFromEveryMotion) {
  for (int n = 3; n <= 7; ++n)
    EXPECT_GT(least_damping(closure::sbp_line_table(n), n), -1e-14) << n;
  for (const int n : {8, 9, 12, 24}) {
    EXPECT_GT(least_damping(closure::sbp_table(2), n), -1e-14) << n;
    EXPECT_GT(least_damping(closure::sbp_table(4), n), -1e-14) << n;
  }
  EXPECT_GT(least_damping(closure::sbp_table(6), 24), -1e-3);
}

/// Of a sheared and stretched box, at all nodes.
template <algebra::Arrangement arrangement>
void expect_slopes_of_plain_sums() {
  meshes::Mesh mesh = meshes::box(CellType::hexahedron, {0, 0, 0}, {1, 2, 1}, {5, 3, 9});
  for (Vec3& X : mesh.nodes)
    X[0] += 0.3 * X[1];
  const meshes::StructuredBlock block = meshes::structured_block(mesh, {});
  const auto [row, neighbour, weight] =
      meshes::line_slopes(block, meshes::cell_edges(mesh, block, {}),
                          [](auto a, auto b) { return a % 2 == 0 || b > 40 ? 1 : 0.7; });
  const scheme::SlopeRows rows{row, neighbour, weight};
  const scheme::SlopeGraph<3> graph(rows, arrangement);
  algebra::TableShape shape{arrangement, rows.reach() + algebra::n_lanes, false};
  algebra::NodeTable v(mesh.n_nodes(), 3, 4, shape);
  const auto velocity = [](std::int64_t a, int i) {
    return std::sin(1.7 * static_cast<double>(a) + i);
  };
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    for (int i = 0; i < 3; ++i)
      v.set(a, i, velocity(a, i));
  }
  for (std::int64_t b = 0; b < algebra::n_blocks_of(mesh.n_nodes()); ++b) {
    algebra::Lanes slopes[9];
    scheme::sum_gradients_of_block<algebra::InstructionSet::baseline, double>(graph, v, b, slopes);
    for (int lane = 0; lane < algebra::n_lanes; ++lane) {
      const std::int64_t a = b * algebra::n_lanes + lane;
      if (a >= mesh.n_nodes()) continue;
      for (int k = 0; k < 9; ++k) {
        double wanted = 0;
        for (std::int64_t p = row[a]; p < row[a + 1]; ++p)
          wanted += (velocity(neighbour[p], k / 3) - velocity(a, k / 3)) * weight[p][k % 3];
        EXPECT_NEAR(slopes[k][lane], wanted, 1e-12) << a << " " << k;
      }
    }
  }
}

TEST(SlopeGraph, SumsTheSameInRowsAndRuns) {
  expect_slopes_of_plain_sums<algebra::Arrangement::rows>();
  expect_slopes_of_plain_sums<algebra::Arrangement::runs>();
}

}  // namespace
}  // namespace diptych::graphs
