#include "common/run/checkerboard.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace diptych::run {

std::vector<std::int32_t> nodes_within(std::int32_t a, int rings, const NodesAround& around) {
  std::vector<std::int32_t> nodes{a};
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<std::int32_t> wider = nodes;
    for (const std::int32_t b : nodes)
      around(b, wider);
    std::sort(wider.begin(), wider.end());
    wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
    nodes = std::move(wider);
  }
  return nodes;
}

Checkerboard::Checkerboard(const std::vector<Vec3>& X,
                           const std::vector<double>& Omega,
                           int dimension,
                           const NodesAround& around)
    : first_{0} {
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(X.size()); ++a) {
    constexpr int most_rings = 3;
    for (int rings = 1; rings <= most_rings; ++rings) {
      std::vector<std::int32_t> near = nodes_within(a, rings, around);
      near.erase(std::find(near.begin(), near.end(), a));
      const auto n = static_cast<Eigen::Index>(near.size());
      const double h = std::pow(Omega[a], 1.0 / dimension);
      Eigen::MatrixXd linear(n, dimension + 1);  // 1 and (X - X_a) / h
      for (Eigen::Index k = 0; k < n; ++k)
        linear.row(k) << 1, ((X[near[k]] - X[a]) / h).head(dimension).transpose();
      const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fit(linear);
      if (fit.rank() <= dimension) continue;
      const Eigen::VectorXd weights = fit.pseudoInverse().row(0);
      neighbour_.insert(neighbour_.end(), near.begin(), near.end());
      weight_.insert(weight_.end(), weights.begin(), weights.end());
      break;
    }
    first_.push_back(static_cast<std::int64_t>(neighbour_.size()));
  }
}

double Checkerboard::part_of(std::span<const double> q, std::span<const double> weights) const {
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double mean = std::inner_product(q.begin(), q.end(), weights.begin(), 0.0) / all;
  double alternating = 0, spread = 0, whole = 0;
  for (size_t a = 0; a < q.size(); ++a) {
    double rest = first_[a] == first_[a + 1] ? 0 : q[a];
    for (std::int64_t k = first_[a]; k < first_[a + 1]; ++k)
      rest -= weight_[k] * q[neighbour_[k]];
    alternating += weights[a] * rest * rest;
    spread += weights[a] * (q[a] - mean) * (q[a] - mean);
    whole += weights[a] * q[a] * q[a];
  }
  constexpr double rounding = 1e-12;
  return spread <= rounding * rounding * whole ? 0 : std::sqrt(alternating / spread);
}

}  // namespace diptych::run
