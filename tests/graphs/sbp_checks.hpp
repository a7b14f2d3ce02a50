#pragma once
/// What operators that sum by parts promise beyond what every graph does.

#include "common/scheme/graph/dissipation_area.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <algorithm>
#include <random>

namespace diptych::graphs {

/// Largest error of the gradient of a polynomial of this degree with random coefficients, over its
/// largest value.
inline double gradient_error(const scheme::PairGraph& graph, int degree) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal;
  Vec3 direction(normal(engine), normal(engine), graph.dimension == 3 ? normal(engine) : 0);
  Vec3 other(normal(engine), normal(engine), graph.dimension == 3 ? normal(engine) : 0);
  std::vector<Vec3> v(graph.X.size(), Vec3::Zero());
  for (size_t a = 0; a < v.size(); ++a)
    v[a][0] = std::pow(direction.dot(graph.X[a]), degree - 1) * other.dot(graph.X[a]);
  double worst = 0, largest = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const double s = direction.dot(graph.X[a]), t = other.dot(graph.X[a]);
    Vec3 exact = std::pow(s, degree - 1) * other;
    if (degree > 1) exact += (degree - 1) * std::pow(s, degree - 2) * t * direction;
    largest = std::max(largest, exact.norm());
    worst = std::max(worst, (gradient(graph, v, a).row(0).transpose() - exact).norm());
  }
  return worst / largest;
}

/// Largest error of the force of a stress that is linear in X, over its divergence.
inline double divergence_error(const scheme::PairGraph& graph) {
  const Mat3 by[3] = {Mat3::Random(), Mat3::Random(),
                      graph.dimension == 3 ? Mat3(Mat3::Random()) : Mat3(Mat3::Zero())};
  std::vector<Mat3> P(graph.X.size());
  Vec3 divergence = Vec3::Zero();
  for (int i = 0; i < graph.dimension; ++i)
    divergence += by[i].col(i);
  for (size_t a = 0; a < P.size(); ++a) {
    P[a] = Mat3::Zero();
    for (int i = 0; i < 3; ++i)
      P[a] += graph.X[a][i] * by[i];
  }
  // 1/2 sum_b (P_a C_ab - P_b C_ba) is Omega_a Div P - P_a A_aN_a with the sign of (18a) turned
  double worst = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const Vec3 T = -force(graph, P, a) + P[a] * -graph.boundary_area[a];
    worst = std::max(worst, (-T - graph.Omega[a] * divergence).norm() / graph.Omega[a]);
  }
  return worst / divergence.norm();
}

/// Least eigenvalue, in c/h, of the symmetric part of what the jumps of linear reconstructions
/// dissipate (notes 4.4): with areas s_ab sum_b s_ab (v_b - v_a - 1/2 (G_a + G_b) X_ab)/Omega_a.
/// @param with_slopes  G of the lines instead of dF/dt
inline double least_dissipation(const scheme::PairGraph& graph, bool with_slopes = false) {
  const auto n = static_cast<int>(graph.n_nodes());
  Eigen::MatrixXd G[3], D = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::MatrixXd& by : G)
    by = Eigen::MatrixXd::Zero(n, n);
  const auto add = [&](int a, int b, const Vec3& weight) {
    for (int i = 0; i < 3; ++i) {
      G[i](a, b) += weight[i];
      G[i](a, a) -= weight[i];
    }
  };
  for (int a = 0; a < n; ++a) {
    for (std::int64_t p = graph.row[a]; !with_slopes && p < graph.row[a + 1]; ++p)
      add(a, graph.neighbour[p], 0.5 * graph.C[p] / graph.Omega[a]);
    for (std::int64_t p = with_slopes ? graph.slopes.row[a] : 0;
         with_slopes && p < graph.slopes.row[a + 1]; ++p)
      add(a, graph.slopes.neighbour[p], graph.slopes.weight[p]);
  }
  for (int a = 0; a < n; ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int32_t b = graph.neighbour[p];
      const Vec3 X_ab = graph.X[b] - graph.X[a], S = 0.5 * (graph.C[p] - graph.C[graph.reverse(p)]);
      const double area = scheme::dissipation_area(S, X_ab, graph.dissipation_metric);
      D(a, a) += area;
      D(a, b) -= area;
      for (int i = 0; i < 3; ++i)
        D.row(a) += 0.5 * area * X_ab[i] * (G[i].row(a) + G[i].row(b));
    }
  }
  Eigen::VectorXd scale(n);
  for (int a = 0; a < n; ++a)
    scale[a] = 1 / std::sqrt(graph.Omega[a]);
  const Eigen::MatrixXd symmetric =
      0.5 * scale.asDiagonal() * (D + D.transpose()) * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

}  // namespace diptych::graphs
