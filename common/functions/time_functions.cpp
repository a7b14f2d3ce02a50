#include "common/functions/time_functions.hpp"

#include "common/algebra/vectors.hpp"
#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych::functions {

namespace {

using Complex = std::complex<double>;

/// The mode in units of the glassy frequency: w^2 + m + sum_a m_a w T_a / (1 + w T_a) = 0 with
/// m + sum m_a = 1.
struct ScaledMode {
  double frequency;              // s^-1, glassy: sqrt(k2 (M + sum M_a) / rho)
  double m;                      // M / (M + sum M_a)
  std::vector<double> m_branch;  // [n_times]
  std::vector<double> T;         // [n_times] frequency * tau_a, distinct
};

/// Matrix of the state (q, q', q_1, ...) in scaled time.
Eigen::MatrixXd state_matrix(const ScaledMode& mode) {
  const int n = static_cast<int>(mode.T.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 + n, 2 + n);
  A(0, 1) = 1;
  A(1, 0) = -1;
  for (int a = 0; a < n; ++a) {
    A(1, 2 + a) = mode.m_branch[a];
    A(2 + a, 0) = 1 / mode.T[a];
    A(2 + a, 2 + a) = -1 / mode.T[a];
  }
  return A;
}

/// One Newton correction of the root w of (w^2 + m) prod(1 + w T) + sum_a m_a w T_a prod_b(1 + w
/// T_b), b != a. The eigenvalue solver alone loses digits in the slow roots when some T_a is small.
Complex newton_correction(const ScaledMode& mode, Complex w) {
  const size_t n = mode.T.size();
  // Product of the factors and its derivative, without factor `skipped`.
  const auto product = [&](size_t skipped) {
    Complex p = 1, dp = 0;
    for (size_t b = 0; b < n; ++b) {
      if (b == skipped) continue;
      dp = dp * (1.0 + w * mode.T[b]) + p * mode.T[b];
      p *= 1.0 + w * mode.T[b];
    }
    return std::pair(p, dp);
  };
  const auto [all, d_all] = product(n);
  Complex f = (w * w + mode.m) * all;
  Complex df = 2.0 * w * all + (w * w + mode.m) * d_all;
  for (size_t a = 0; a < n; ++a) {
    const auto [rest, d_rest] = product(a);
    f += mode.m_branch[a] * mode.T[a] * w * rest;
    df += mode.m_branch[a] * mode.T[a] * (rest + w * d_rest);
  }
  return df == 0.0 ? Complex(0) : -f / df;
}

std::vector<Complex> scaled_roots(const ScaledMode& mode) {
  const Eigen::VectorXcd eigenvalues =
      Eigen::EigenSolver<Eigen::MatrixXd>(state_matrix(mode), false).eigenvalues();
  std::vector<Complex> roots(eigenvalues.data(), eigenvalues.data() + eigenvalues.size());
  for (Complex& w : roots) {
    for (int i = 0; i < 4; ++i) {
      const Complex step = newton_correction(mode, w);
      if (std::abs(step) > 1e-2 * std::abs(w)) break;  // a near double root: keep the eigenvalue
      w += step;
    }
  }
  return roots;
}

/// Eigenvector of root w: (1, w, 1/(1 + w T_a), ...), scaled to greatest entry 1.
Eigen::VectorXcd eigenvector(const ScaledMode& mode, Complex w) {
  const size_t n = mode.T.size();
  size_t nearest = n;  // the branch whose pole is next to w, if any
  for (size_t a = 0; a < n; ++a) {
    if (std::abs(1.0 + w * mode.T[a]) < 0.1) nearest = a;
  }
  // Near its pole 1 + w T has no digits left; the row of momentum, (w^2 + 1) q = sum_a m_a q_a,
  // then gives that entry.
  Eigen::VectorXcd v(n + 2);
  v[0] = 1;
  v[1] = w;
  Complex rest = w * w + 1.0;
  for (size_t a = 0; a < n; ++a) {
    if (a == nearest) continue;
    v[2 + a] = 1.0 / (1.0 + w * mode.T[a]);
    rest -= mode.m_branch[a] * v[2 + a];
  }
  if (nearest < n) v[2 + nearest] = rest / mode.m_branch[nearest];
  return v / v.cwiseAbs().maxCoeff();
}

ScaledMode scaled_mode(const ZenerModeParameters& p,
                       const std::vector<double>& times,
                       const std::vector<size_t>& time_of) {
  double glassy = p.modulus;
  for (const double M : p.branch_moduli)
    glassy += M;
  ScaledMode mode;
  mode.frequency = std::sqrt(p.wave_number_squared * glassy / p.density);
  mode.m = p.modulus / glassy;
  mode.m_branch.assign(times.size(), 0.0);
  for (size_t a = 0; a < time_of.size(); ++a)
    mode.m_branch[time_of[a]] += p.branch_moduli[a] / glassy;
  for (const double tau : times)
    mode.T.push_back(mode.frequency * tau);
  return mode;
}

}  // namespace

ZenerMode::ZenerMode(std::string name, const ZenerModeParameters& parameters)
    : name_(std::move(name)), parameters_(parameters) {
  // Branches of equal time start equal and stay equal: one unknown for all of them.
  for (const double tau : parameters_.branch_times) {
    const auto found = std::find(times_.begin(), times_.end(), tau);
    time_of_.push_back(static_cast<size_t>(found - times_.begin()));
    if (found == times_.end()) times_.push_back(tau);
  }
  const ScaledMode mode = scaled_mode(parameters_, times_, time_of_);
  const std::vector<Complex> w = scaled_roots(mode);
  const size_t n = times_.size(), size = n + 2;

  Eigen::MatrixXcd V(size, size);
  for (size_t j = 0; j < size; ++j)
    V.col(j) = eigenvector(mode, w[j]);
  Eigen::VectorXcd start(size);
  start[0] = parameters_.amplitude;
  start[1] = parameters_.rate / mode.frequency;
  for (size_t a = 0; a < n; ++a)
    start[2 + a] = parameters_.relaxed ? parameters_.amplitude : 0.0;
  const Eigen::VectorXcd c = V.fullPivLu().solve(start);

  // Near a double root the parts grow like 1/distance and cancel: 1e6 leaves ten digits.
  const double greatest = start.cwiseAbs().maxCoeff();
  if (!(c.cwiseAbs().maxCoeff() <= 1e6 * greatest) ||
      !((V * c - start).cwiseAbs().maxCoeff() <= 1e-9 * greatest)) {
    throw base::InputError("functions." + name_ +
                           ": two roots of the mode coincide (critical damping); change a branch "
                           "time or modulus by a thousandth");
  }
  for (size_t j = 0; j < size; ++j) {
    roots_.push_back(w[j] * mode.frequency);
    weight_.push_back(V(0, j) * c[j]);
  }
  for (size_t a = 0; a < n; ++a) {
    for (size_t j = 0; j < size; ++j)
      branch_weight_.push_back(V(2 + a, j) * c[j]);
  }
}

std::vector<std::string> ZenerMode::names() const {
  std::vector<std::string> all{name_, name_ + "_dot", name_ + "_ddot"};
  for (size_t a = 0; a < time_of_.size(); ++a)
    all.push_back(name_ + "_" + std::to_string(a + 1));
  return all;
}

std::vector<double> ZenerMode::values(double t) const {
  const size_t size = roots_.size();
  double q = 0, q_dot = 0;
  std::vector<double> q_branch(times_.size(), 0.0);
  for (size_t j = 0; j < size; ++j) {
    const Complex wave = std::exp(roots_[j] * t);
    q += (weight_[j] * wave).real();
    q_dot += (weight_[j] * roots_[j] * wave).real();
    for (size_t a = 0; a < times_.size(); ++a)
      q_branch[a] += (branch_weight_[a * size + j] * wave).real();
  }
  const ZenerModeParameters& p = parameters_;
  double stress = p.modulus * q;
  for (size_t a = 0; a < time_of_.size(); ++a)
    stress += p.branch_moduli[a] * (q - q_branch[time_of_[a]]);
  std::vector<double> all{q, q_dot, -p.wave_number_squared / p.density * stress};
  for (const size_t a : time_of_)
    all.push_back(q_branch[a]);
  return all;
}

}  // namespace diptych::functions
