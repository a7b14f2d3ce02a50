#include "common/scheme/closure_repair.hpp"

#include "common/scheme/conjugate_gradients.hpp"
#include "common/scheme/spline_levels.hpp"

#include <cmath>

namespace diptych::scheme {

namespace {

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

/// One of the two corrections: C is changed by a linear function of y, the gap by -S y.
class Correction {
 public:
  virtual ~Correction() = default;
  virtual void apply_S(const Field& y, Field& Sy) = 0;
  virtual void precondition(const Field& r, Field& z) = 0;
  virtual void change(const Field& y, std::vector<Vec3>& C) = 0;
};

void divide(const Field& r, const std::vector<double>& diagonal, Field& z) {
  for (size_t a = 0; a < r.size(); ++a) {
    z[a] = diagonal[a] > 0 ? Vec3(r[a] / diagonal[a]) : Vec3(Vec3::Zero());
  }
}

/// dC_ab = -2 w_ab gamma_a with gamma = A^T y, which is the gamma of least norm: S = A A^T,
///   (A gamma)_a = sum_b (w_ab gamma_a - w_ba gamma_b),  (A^T y)_a = sum_b w_ab (y_a - y_b).
class RowCorrection : public Correction {
 public:
  RowCorrection(const PairGraph& graph, const std::vector<double>& w)
      : graph_(graph),
        w_(w),
        w_reverse_(w.size()),
        sum_(graph.X.size(), 0.0),
        diagonal_(graph.X.size(), 0.0),
        gamma_(graph.X.size()) {
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        w_reverse_[p] = w[graph.reverse[p]];
        sum_[a] += w[p];
        diagonal_[a] += w_reverse_[p] * w_reverse_[p];
      }
      diagonal_[a] += sum_[a] * sum_[a];
    }
  }
  void apply_S(const Field& y, Field& Sy) override {
    apply(w_, y, gamma_);
    apply(w_reverse_, gamma_, Sy);
  }
  void precondition(const Field& r, Field& z) override { divide(r, diagonal_, z); }
  void change(const Field& y, std::vector<Vec3>& C) override {
    apply(w_, y, gamma_);
    for (std::int64_t a = 0; a < graph_.n_nodes(); ++a) {
      for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p)
        C[p] -= 2 * w_[p] * gamma_[a];
    }
  }

 private:
  /// out_a = (sum_b w_ab) in_a - sum_b weight_ab in_b
  void apply(const std::vector<double>& weight, const Field& in, Field& out) const {
    for_each_node(in.size(), [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a) {
        Vec3 s = sum_[a] * in[a];
        for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
          s -= weight[p] * in[graph_.neighbour[p]];
        }
        out[a] = s;
      }
    });
  }
  const PairGraph& graph_;
  const std::vector<double>& w_;
  std::vector<double> w_reverse_, sum_, diagonal_;
  Field gamma_;
};

/// M_a^-1 = (sum_b k_ab X_ab (x) X_ab)^-1 of every row; a third direction of its own in 2-D.
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

/// sum_b k_ab X_ab
Vec3 first_moment(const PairGraph& graph, const std::vector<double>& k, std::int64_t a) {
  Vec3 m = Vec3::Zero();
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
    m += k[p] * (graph.X[graph.neighbour[p]] - graph.X[a]);
  }
  return m;
}

/// dC_ab = 1/2 k_ab [lambda_b - lambda_a - (grad lambda)_a X_ab]; the gap changes by -S lambda,
///   (S lambda)_a = -1/4 sum_b k_ab [2 (lambda_b - lambda_a) - (grad_a + grad_b) X_ab].
class PairCorrection : public Correction {
 public:
  PairCorrection(const PairGraph& graph, const std::vector<double>& k)
      : graph_(graph),
        k_(k),
        inverse_(inverse_second_moments(graph, k)),
        diagonal_(graph.X.size(), 0.0),
        slope_(graph.X.size()),
        smooth_(graph, k, inverse_) {
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      const Vec3 m = inverse_[a] * first_moment(graph, k, a);
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const Vec3 X_ab = graph.X[graph.neighbour[p]] - graph.X[a];
        const double fitted = k[p] * X_ab.dot(inverse_[graph.neighbour[p]] * X_ab);
        diagonal_[a] += 0.25 * k[p] * (2 - X_ab.dot(m) - fitted);
      }
    }
  }
  void apply_S(const Field& lambda, Field& S_lambda) override {
    fit(lambda);
    const std::vector<Vec3>& X = graph_.X;
    for_each_node(X.size(), [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a) {
        Vec3 s = Vec3::Zero();
        for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
          const std::int32_t b = graph_.neighbour[p];
          s += k_[p] * (2 * (lambda[b] - lambda[a]) - (slope_[a] + slope_[b]) * (X[b] - X[a]));
        }
        S_lambda[a] = -0.25 * s;
      }
    });
  }
  void precondition(const Field& r, Field& z) override {
    divide(r, diagonal_, z);
    smooth_.add(r, z);
  }
  void change(const Field& lambda, std::vector<Vec3>& C) override {
    fit(lambda);
    const std::vector<Vec3>& X = graph_.X;
    for (std::int64_t a = 0; a < graph_.n_nodes(); ++a) {
      for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
        const std::int32_t b = graph_.neighbour[p];
        C[p] += 0.5 * k_[p] * (lambda[b] - lambda[a] - slope_[a] * (X[b] - X[a]));
      }
    }
  }

 private:
  /// slope_[a] = grad lambda, row i the gradient of component i.
  void fit(const Field& lambda) {
    const std::vector<Vec3>& X = graph_.X;
    for_each_node(X.size(), [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a) {
        Mat3 m = Mat3::Zero();
        for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
          const std::int32_t b = graph_.neighbour[p];
          m += (k_[p] * (lambda[b] - lambda[a])) * (X[b] - X[a]).transpose();
        }
        slope_[a] = m * inverse_[a];
      }
    });
  }
  const PairGraph& graph_;
  const std::vector<double>& k_;
  std::vector<Mat3> inverse_;
  std::vector<double> diagonal_;
  std::vector<Mat3> slope_;
  SplineLevels smooth_;
};

double relative_change(const std::vector<Vec3>& C, const std::vector<Vec3>& C_before) {
  double change = 0, size = 0;
  for (size_t p = 0; p < C.size(); ++p) {
    change += (C[p] - C_before[p]).norm();
    size += C_before[p].norm();
  }
  return change / size;
}

constexpr int most_passes = 4;

/// Solves for the gap and applies the correction, again for what round-off left, as long as that
/// halves it.
ClosureRepair repair(PairGraph& graph, Correction& correction, const RepairLimits& limits) {
  ClosureRepair result;
  const std::vector<double> unit = area_units(graph);
  const AffinePart affine_part(graph.X);
  const FieldOperator S = [&](const Field& y, Field& Sy) { correction.apply_S(y, Sy); };
  const FieldOperator inverse = [&](const Field& r, Field& z) { correction.precondition(r, z); };
  const std::vector<Vec3> C_before = graph.C;
  Field gap = closure_gap(graph), y;
  result.before = result.after = greatest(gap, unit);
  for (int pass = 0; pass < most_passes && !(result.after <= limits.closure); ++pass) {
    const SolveLimits left{0.5 * limits.closure, limits.iterations - result.iterations};
    result.iterations += conjugate_gradients(S, inverse, affine_part, unit, left, gap, y);
    std::vector<Vec3> C = graph.C;
    correction.change(y, C);
    C.swap(graph.C);
    gap = closure_gap(graph);
    const double before = result.after, after = greatest(gap, unit);
    if (!(after < before)) {
      C.swap(graph.C);
      break;
    }
    result.after = after;
    if (after > 0.5 * before) break;
  }
  result.mean_change = relative_change(graph.C, C_before);
  return result;
}

}  // namespace

std::vector<double> moment_free_weights(const PairGraph& graph, const std::vector<double>& k) {
  const std::vector<Mat3> inverse = inverse_second_moments(graph, k);
  std::vector<double> w(k.size(), 0.0);
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const std::int64_t begin = graph.row[a], end = graph.row[a + 1];
    if (end - begin <= graph.dimension) continue;
    const Vec3 slope = inverse[a] * first_moment(graph, k, a);
    for (std::int64_t p = begin; p < end; ++p) {
      w[p] = k[p] * (1 - slope.dot(graph.X[graph.neighbour[p]] - graph.X[a]));
    }
  }
  return w;
}

ClosureRepair repair_closure_rows(PairGraph& graph,
                                  const std::vector<double>& w,
                                  const RepairLimits& limits) {
  RowCorrection correction(graph, w);
  return repair(graph, correction, limits);
}

ClosureRepair repair_closure_pairs(PairGraph& graph,
                                   const std::vector<double>& k,
                                   const RepairLimits& limits) {
  PairCorrection correction(graph, k);
  return repair(graph, correction, limits);
}

}  // namespace diptych::scheme
