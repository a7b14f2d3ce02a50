/// By Golub and Welsch: the recurrence of the orthogonal polynomials by Stieltjes' procedure on a
/// fine composite rule (moments would lose all digits), nodes and weights as eigenvalues and first
/// components of eigenvectors of the Jacobi matrix.

#include "common/exact/manufactured/exponential_gauss.hpp"

#include "common/algebra/vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace diptych::exact {

namespace {

// Gauss-Legendre, 10 points on (-1, 1): Abramowitz and Stegun, table 25.4
constexpr std::array legendre_node{0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                   0.8650633666889845, 0.9739065285171717};
constexpr std::array legendre_weight{0.2955242247147529, 0.2692667193099963, 0.2190863625159821,
                                     0.1494513491505806, 0.0666713443086881};

/// Points of a measure.
struct Measure {
  std::vector<double> u, w;
};

/// z e^(-zu) du on [0, 1]; beyond u = 45/z the weight is below rounding.
Measure discretised_weight(double z) {
  const double end = std::min(1.0, 45 / z);
  const int n_panels = std::max(2, static_cast<int>(std::ceil(2 * z * end)));
  Measure m;
  for (int panel = 0; panel < n_panels; ++panel) {
    const double half = 0.5 * end / n_panels, middle = (2 * panel + 1) * half;
    for (size_t k = 0; k < legendre_node.size(); ++k) {
      for (const double side : {-1.0, 1.0}) {
        m.u.push_back(middle + side * half * legendre_node[k]);
        m.w.push_back(half * legendre_weight[k] * z * std::exp(-z * m.u.back()));
      }
    }
  }
  return m;
}

}  // namespace

ExponentialGauss exponential_gauss(int n_points, double z) {
  ExponentialGauss rule;
  rule.old = std::exp(-z);
  const Measure m = discretised_weight(z);
  const auto total = static_cast<Eigen::Index>(m.u.size());
  const Eigen::Map<const Eigen::ArrayXd> u(m.u.data(), total), w(m.w.data(), total);
  // p_(k+1) = (u - a_k) p_k - b_k p_(k-1), normalised as it goes
  Eigen::ArrayXd before = Eigen::ArrayXd::Zero(total), now = Eigen::ArrayXd::Ones(total);
  now /= std::sqrt((w * now * now).sum());
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n_points, n_points);
  double off_diagonal = 0;
  for (int k = 0; k < n_points; ++k) {
    const double a = (w * u * now * now).sum();
    jacobi(k, k) = a;
    if (k + 1 == n_points) break;
    Eigen::ArrayXd next = (u - a) * now - off_diagonal * before;
    off_diagonal = std::sqrt((w * next * next).sum());
    jacobi(k, k + 1) = jacobi(k + 1, k) = off_diagonal;
    before = now;
    now = next / off_diagonal;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(jacobi);
  for (int k = 0; k < n_points; ++k) {
    const double first = modes.eigenvectors()(0, k);
    rule.weight.push_back(-std::expm1(-z) * first * first);
    rule.theta.push_back(1 - modes.eigenvalues()[k]);
  }
  return rule;
}

ExponentialGauss exponential_rule(const std::vector<double>& theta, double z) {
  const Measure m = discretised_weight(z);
  ExponentialGauss rule{std::exp(-z), std::vector<double>(theta.size(), 0.0), theta};
  for (size_t at = 0; at < m.u.size(); ++at) {
    for (size_t k = 0; k < theta.size(); ++k) {
      double of_point = m.w[at];  // times its Lagrange polynomial
      for (size_t j = 0; j < theta.size(); ++j)
        of_point *= j == k ? 1 : (1 - m.u[at] - theta[j]) / (theta[k] - theta[j]);
      rule.weight[k] += of_point;
    }
  }
  return rule;
}

}  // namespace diptych::exact
