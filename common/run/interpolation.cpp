#include "common/run/interpolation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace diptych::run {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using algebra::Mat3;

double size_of(const std::vector<double>& weights) {
  return std::accumulate(weights.begin(), weights.end(), 0.0,
                         [](double sum, double w) { return sum + std::abs(w); });
}

/// 1, the coordinates and, of degree 2, their products.
Vector monomials(const Vec3& x, int dimension, int degree) {
  std::vector<double> values{1};
  for (int i = 0; i < dimension; ++i)
    values.push_back(x[i]);
  for (int i = 0; i < dimension && degree == 2; ++i) {
    for (int j = i; j < dimension; ++j)
      values.push_back(x[i] * x[j]);
  }
  return Eigen::Map<Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Weights that are exact for polynomials of the degree, or none.
std::vector<double> exact_weights(const std::vector<Vec3>& x, int dimension, int degree) {
  constexpr double rounding = 1e-9;
  const Vector wanted = monomials(Vec3::Zero(), dimension, degree);
  Matrix conditions(wanted.size(), static_cast<Eigen::Index>(x.size()));
  Vector nearness(conditions.cols());
  for (Eigen::Index k = 0; k < conditions.cols(); ++k) {
    const Vec3& X = x[static_cast<size_t>(k)];
    nearness[k] = std::exp(-0.5 * X.squaredNorm());
    conditions.col(k) = nearness[k] * monomials(X, dimension, degree);
  }
  const Vector least = Eigen::CompleteOrthogonalDecomposition<Matrix>(conditions).solve(wanted);
  if ((conditions * least - wanted).cwiseAbs().maxCoeff() > rounding) return {};
  const Vector weights = nearness.cwiseProduct(least);
  return {weights.begin(), weights.end()};
}

/// Makes the nodes of the first ring lie around a place at a distance of about one along every
/// direction, whatever the shape of the cells.
Mat3 measure_of(const std::vector<std::int32_t>& nearest,
                const std::vector<Vec3>& X,
                int dimension,
                double spacing,
                const NodesAround& around) {
  Mat3 spread = Mat3::Identity() * 1e-12 * spacing * spacing;
  for (const std::int32_t a : nearest) {
    const std::vector<std::int32_t> ring = nodes_within(a, 1, around);
    for (const std::int32_t b : ring) {
      const Vec3 r = X[static_cast<size_t>(b)] - X[static_cast<size_t>(a)];
      spread += r * r.transpose() / static_cast<double>(ring.size() * nearest.size());
    }
  }
  if (dimension == 2) spread(2, 2) = 1;
  return spread.llt().matrixL().solve(Mat3::Identity());
}

/// Ascending.
std::vector<std::int32_t> nodes_within_of_all(const std::vector<std::int32_t>& nearest,
                                              int rings,
                                              const NodesAround& around) {
  std::vector<std::int32_t> all;
  for (const std::int32_t a : nearest) {
    const std::vector<std::int32_t> nodes = nodes_within(a, rings, around);
    all.insert(all.end(), nodes.begin(), nodes.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

std::vector<std::int32_t> nearest_nodes(const Vec3& place,
                                        const std::vector<Vec3>& X,
                                        const std::vector<std::int32_t>& corners,
                                        const NodesAround& around) {
  constexpr double rounding = 1e-9;
  const auto distance = [&](std::int32_t a) { return (X[static_cast<size_t>(a)] - place).norm(); };
  std::vector<std::int32_t> near = nodes_within_of_all(corners, 1, around);
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t a : near)
    least = std::min(least, distance(a));
  std::erase_if(near, [&](std::int32_t a) { return distance(a) > (1 + rounding) * least; });
  return near;
}

Interpolation interpolation_at(const Vec3& place,
                               const std::vector<Vec3>& X,
                               int dimension,
                               const std::vector<std::int32_t>& nearest,
                               double spacing,
                               const NodesAround& around) {
  constexpr double at_node = 1e-6;
  constexpr int most_rings = 3;
  Interpolation best{{nearest.front()}, {1}};
  if ((X[static_cast<size_t>(nearest.front())] - place).norm() <= at_node * spacing) return best;
  const Mat3 measure = measure_of(nearest, X, dimension, spacing, around);
  double least = std::numeric_limits<double>::infinity();
  for (const int degree : {2, 1}) {
    for (int rings = 1; rings <= most_rings; ++rings) {
      std::vector<std::int32_t> nodes = nodes_within_of_all(nearest, rings, around);
      std::vector<Vec3> x;
      for (const std::int32_t a : nodes)
        x.emplace_back(measure * (X[static_cast<size_t>(a)] - place));
      std::vector<double> weights = exact_weights(x, dimension, degree);
      const double size = size_of(weights);
      if (weights.empty() || size >= least) continue;
      least = size;
      best = {std::move(nodes), std::move(weights)};
      if (size <= most_size_of_weights) return best;
    }
  }
  return best;
}

}  // namespace diptych::run
