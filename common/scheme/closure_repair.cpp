#include "common/scheme/closure_repair.hpp"

#include "common/scheme/spline_levels.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace diptych::scheme {

namespace {

using Field = std::vector<Vec3>;
using Operator = std::function<void(const Field& y, Field& Sy)>;
/// z = approximate S^-1 r
using Preconditioner = std::function<void(const Field& r, Field& z)>;

/// What is missing: A_aN_a + 1/2 sum_b (C_ab - C_ba).
Field closure_gap(const PairGraph& graph) {
  Field gap = graph.boundary_area;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    Vec3 sum = Vec3::Zero();
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      sum += graph.C[p] - graph.C[graph.reverse[p]];
    }
    gap[a] += 0.5 * sum;
  }
  return gap;
}

/// 1 / Omega_a^((d-1)/d), the unit of a node's closure.
std::vector<double> area_units(const PairGraph& graph) {
  std::vector<double> unit(graph.Omega.size());
  const double power = (1.0 - graph.dimension) / graph.dimension;
  for (size_t a = 0; a < unit.size(); ++a)
    unit[a] = std::pow(graph.Omega[a], power);
  return unit;
}

double greatest(const Field& gap, const std::vector<double>& unit) {
  double result = 0;
  for (size_t a = 0; a < gap.size(); ++a)
    result = std::max(result, gap[a].norm() * unit[a]);
  return result;
}

Vec3 dot(const Field& x, const Field& y) {
  Vec3 sum = Vec3::Zero();
  for (size_t a = 0; a < x.size(); ++a)
    sum += x[a].cwiseProduct(y[a]);
  return sum;
}

/// x / y by component, 0 where y is: a component that is solved (or absent, z in 2-D) rests.
Vec3 quotient(const Vec3& x, const Vec3& y) {
  Vec3 result = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (y[i] > 0) result[i] = x[i] / y[i];
  }
  return result;
}

Preconditioner by_diagonal(std::vector<double> diagonal) {
  return [diagonal = std::move(diagonal)](const Field& r, Field& z) {
    for (size_t a = 0; a < r.size(); ++a) {
      z[a] = diagonal[a] > 0 ? Vec3(r[a] / diagonal[a]) : Vec3(Vec3::Zero());
    }
  };
}

/// Preconditioned conjugate gradients for S y = r, the three components side by side (each with
/// its own step lengths), from y = 0.
/// @return steps taken
int conjugate_gradients(const Operator& S,
                        const Preconditioner& precondition,
                        const std::vector<double>& unit,
                        Field r,
                        const RepairLimits& limits,
                        Field& y) {
  const size_t n = r.size();
  y.assign(n, Vec3::Zero());
  Field p(n), Sp(n), z(n);
  precondition(r, z);
  p = z;
  Vec3 rz = dot(r, z);
  int step = 0;
  while (step < limits.iterations && greatest(r, unit) > 0.3 * limits.closure) {
    S(p, Sp);
    const Vec3 alpha = quotient(rz, dot(p, Sp));
    for (size_t a = 0; a < n; ++a) {
      y[a] += alpha.cwiseProduct(p[a]);
      r[a] -= alpha.cwiseProduct(Sp[a]);
    }
    precondition(r, z);
    const Vec3 rz_next = dot(r, z);
    const Vec3 beta = quotient(rz_next, rz);
    for (size_t a = 0; a < n; ++a)
      p[a] = z[a] + beta.cwiseProduct(p[a]);
    rz = rz_next;
    ++step;
  }
  return step;
}

/// Solves for the gap and applies the correction, again for what round-off left (at most five
/// times, as long as it helps).
ClosureRepair repair(PairGraph& graph,
                     const Operator& S,
                     const Preconditioner& precondition,
                     const std::function<void(const Field& y)>& correct,
                     const RepairLimits& limits) {
  ClosureRepair result;
  const std::vector<double> unit = area_units(graph);
  Field gap = closure_gap(graph), y;
  result.before = result.after = greatest(gap, unit);
  const std::vector<Vec3> C_before = graph.C;
  for (int pass = 0; pass < 5 && result.after > limits.closure; ++pass) {
    RepairLimits left = limits;
    left.iterations -= result.iterations;
    result.iterations += conjugate_gradients(S, precondition, unit, gap, left, y);
    const std::vector<Vec3> C_last = graph.C;
    correct(y);
    gap = closure_gap(graph);
    const double after = greatest(gap, unit);
    if (!(after < result.after)) {
      graph.C = C_last;
      break;
    }
    const bool slow = after > 0.5 * result.after;
    result.after = after;
    if (slow) break;
  }
  double change = 0, size = 0;
  for (size_t p = 0; p < C_before.size(); ++p) {
    change += (graph.C[p] - C_before[p]).norm();
    size += C_before[p].norm();
  }
  result.mean_change = change / size;
  return result;
}

/// M_a^-1 = (sum_b k_ab X_ab (x) X_ab)^-1 of every row; a unit third direction in 2-D.
std::vector<Mat3> inverse_second_moments(const PairGraph& graph, const std::vector<double>& k) {
  std::vector<Mat3> inverse(graph.X.size());
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    Mat3 M = Mat3::Zero();
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const Vec3 X_ab = graph.X[graph.neighbour[p]] - graph.X[a];
      M += k[p] * X_ab * X_ab.transpose();
    }
    if (graph.dimension == 2) M(2, 2) = M.trace();
    inverse[a] = M.inverse();
  }
  return inverse;
}

}  // namespace

std::vector<double> moment_free_weights(const PairGraph& graph, const std::vector<double>& k) {
  const std::vector<Mat3> inverse = inverse_second_moments(graph, k);
  std::vector<double> w(k.size());
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const std::int64_t begin = graph.row[a], end = graph.row[a + 1];
    if (end - begin <= graph.dimension) continue;
    Vec3 m = Vec3::Zero();
    for (std::int64_t p = begin; p < end; ++p) {
      m += k[p] * (graph.X[graph.neighbour[p]] - graph.X[a]);
    }
    const Vec3 slope = inverse[a] * m;
    for (std::int64_t p = begin; p < end; ++p) {
      w[p] = k[p] * (1 - slope.dot(graph.X[graph.neighbour[p]] - graph.X[a]));
    }
  }
  return w;
}

ClosureRepair repair_closure_rows(PairGraph& graph,
                                  const std::vector<double>& w,
                                  const RepairLimits& limits) {
  const std::int64_t n = graph.n_nodes();
  std::vector<double> w_reverse(w.size()), sum(graph.X.size(), 0.0), diagonal(graph.X.size());
  for (std::int64_t a = 0; a < n; ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      w_reverse[p] = w[graph.reverse[p]];
      sum[a] += w[p];
      diagonal[a] += w_reverse[p] * w_reverse[p];
    }
    diagonal[a] += sum[a] * sum[a];
  }
  // A^T y = sum_b w_ab (y_a - y_b);  (A gamma)_a = sum_b (w_ab gamma_a - w_ba gamma_b)
  Field gamma(graph.X.size());
  const auto transposed = [&](const Field& y) {
    for (std::int64_t a = 0; a < n; ++a) {
      Vec3 g = sum[a] * y[a];
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        g -= w[p] * y[graph.neighbour[p]];
      }
      gamma[a] = g;
    }
  };
  const Operator S = [&](const Field& y, Field& Sy) {
    transposed(y);
    for (std::int64_t a = 0; a < n; ++a) {
      Vec3 s = sum[a] * gamma[a];
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        s -= w_reverse[p] * gamma[graph.neighbour[p]];
      }
      Sy[a] = s;
    }
  };
  const auto correct = [&](const Field& y) {
    transposed(y);
    for (std::int64_t a = 0; a < n; ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        graph.C[p] -= 2 * w[p] * gamma[a];
      }
    }
  };
  return repair(graph, S, by_diagonal(std::move(diagonal)), correct, limits);
}

ClosureRepair repair_closure_pairs(PairGraph& graph,
                                   const std::vector<double>& k,
                                   const RepairLimits& limits) {
  const std::int64_t n = graph.n_nodes();
  const std::vector<Vec3>& X = graph.X;
  const std::vector<Mat3> inverse = inverse_second_moments(graph, k);
  std::vector<Mat3> slope(X.size());  // row i: gradient of component i of lambda
  const auto fit = [&](const Field& lambda) {
    for (std::int64_t a = 0; a < n; ++a) {
      Mat3 m = Mat3::Zero();
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const std::int32_t b = graph.neighbour[p];
        m += (k[p] * (lambda[b] - lambda[a])) * (X[b] - X[a]).transpose();
      }
      slope[a] = m * inverse[a];
    }
  };
  const Operator S = [&](const Field& lambda, Field& S_lambda) {
    fit(lambda);
    for (std::int64_t a = 0; a < n; ++a) {
      Vec3 s = Vec3::Zero();
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const std::int32_t b = graph.neighbour[p];
        s += k[p] * (2 * (lambda[b] - lambda[a]) - (slope[a] + slope[b]) * (X[b] - X[a]));
      }
      S_lambda[a] = -0.25 * s;
    }
  };
  std::vector<double> diagonal(X.size(), 0.0);
  for (std::int64_t a = 0; a < n; ++a) {
    Vec3 m = Vec3::Zero();
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      m += k[p] * (X[graph.neighbour[p]] - X[a]);
    }
    m = inverse[a] * m;
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int32_t b = graph.neighbour[p];
      const Vec3 X_ab = X[b] - X[a];
      diagonal[a] += 0.25 * k[p] * (2 - X_ab.dot(m) - k[p] * X_ab.dot(inverse[b] * X_ab));
    }
  }
  const auto correct = [&](const Field& lambda) {
    fit(lambda);
    for (std::int64_t a = 0; a < n; ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const std::int32_t b = graph.neighbour[p];
        graph.C[p] += 0.5 * k[p] * (lambda[b] - lambda[a] - slope[a] * (X[b] - X[a]));
      }
    }
  };
  const Preconditioner rough = by_diagonal(std::move(diagonal));
  const SplineLevels smooth(graph, k, inverse);
  const Preconditioner precondition = [&](const Field& r, Field& z) {
    rough(r, z);
    smooth.add(r, z);
  };
  return repair(graph, S, precondition, correct, limits);
}

}  // namespace diptych::scheme
