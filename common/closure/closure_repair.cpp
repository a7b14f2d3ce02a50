#include "common/closure/closure_repair.hpp"

#include "common/closure/closure_correction.hpp"
#include "common/closure/closure_gap.hpp"
#include "common/closure/pair_correction.hpp"

#include <cmath>
#include <functional>
#include <memory>

namespace diptych::closure {

namespace {

/// dC_ab = -2 w_ab gamma_a with gamma = A^T y, which is the gamma of least norm: S = A A^T,
///   (A gamma)_a = sum_b (w_ab gamma_a - w_ba gamma_b),  (A^T y)_a = sum_b w_ab (y_a - y_b).
class RowCorrection : public Correction {
 public:
  RowCorrection(const scheme::PairGraph& graph, const std::vector<double>& w)
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
  const scheme::PairGraph& graph_;
  const std::vector<double>& w_;
  std::vector<double> w_reverse_, sum_, diagonal_;
  Field gamma_;
};

constexpr int most_passes = 4;

using CorrectionMaker = std::function<std::unique_ptr<Correction>()>;

/// Solves for the gap and applies the correction, again for what round-off left, as long as that
/// halves it. A graph without a gap, such as that of a box of cells, makes no correction at all.
ClosureRepair repair(scheme::PairGraph& graph,
                     const CorrectionMaker& make,
                     const RepairLimits& limits) {
  ClosureRepair result;
  const std::vector<double> unit = area_units(graph);
  Field gap = closure_gap(graph), y;
  result.before = result.after = greatest(gap, unit);
  if (result.before <= limits.closure) return result;
  const std::unique_ptr<Correction> correction = make();
  const AffinePart affine_part(graph.X);
  const FieldOperator S = [&](const Field& in, Field& out) { correction->apply_S(in, out); };
  const FieldOperator inverse = [&](const Field& r, Field& z) { correction->precondition(r, z); };
  for (int pass = 0; pass < most_passes && !(result.after <= limits.closure); ++pass) {
    const SolveLimits left{0.5 * limits.closure, limits.iterations - result.iterations};
    result.iterations += conjugate_gradients(S, inverse, affine_part, unit, left, gap, y);
    std::vector<Vec3> C_before = graph.C;
    correction->change(y, graph.C);
    gap = closure_gap(graph);
    const double before = result.after, after = greatest(gap, unit);
    if (!(after < before)) {
      graph.C.swap(C_before);
      break;
    }
    result.after = after;
    if (after > 0.5 * before) break;
  }
  return result;
}

}  // namespace

std::vector<double> moment_free_weights(const scheme::PairGraph& graph,
                                        const std::vector<double>& k) {
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

ClosureRepair repair_closure_rows(scheme::PairGraph& graph,
                                  const std::vector<double>& w,
                                  const RepairLimits& limits) {
  return repair(
      graph, [&] { return std::make_unique<RowCorrection>(graph, w); }, limits);
}

ClosureRepair repair_closure_pairs(scheme::PairGraph& graph,
                                   const std::vector<double>& k,
                                   const RepairLimits& limits) {
  return repair(
      graph, [&] { return std::make_unique<PairCorrection>(graph, k); }, limits);
}

}  // namespace diptych::closure
