#include "common/closure/summation_by_parts.hpp"

#include "common/base/error.hpp"
#include "common/closure/closure_gap.hpp"
#include "common/closure/closure_repair.hpp"
#include "common/closure/cubic_part.hpp"
#include "common/closure/minimal_residuals.hpp"
#include "common/closure/quadratic_correction.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::closure {

namespace {

/// A residual that may be left in the end. Bodies of two uneven cells across have no operators that
/// miss by less (meshes/moment_balance.hpp), and bend as they should with these, three times as far
/// with the gradients of second order that stand in else (notes 4.5).
constexpr double most_residual = 0.3;

/// Nodes whose adjoint misses its conditions.
template <int D>
std::vector<std::int32_t> open_nodes(const Field& r, const std::vector<double>& unit) {
  std::vector<std::int32_t> open;
  for (size_t a = 0; a < unit.size(); ++a) {
    double missing = 0;
    for (int i = 0; i <= D; ++i)
      missing = std::max(missing, r[a * (1 + D) + static_cast<size_t>(i)].norm() * unit[a]);
    if (!(missing <= most_residual)) open.push_back(static_cast<std::int32_t>(a));
  }
  return open;
}

/// Iterations without progress after which conditions contradict each other: few neighbours at a
/// corner, or sides that no areas suit.
constexpr int patience = 250;

bool is_solved(const FieldOperator& S,
               const std::vector<double>& unit,
               double residual,
               const Field& r,
               const Field& y) {
  Field left(r.size());
  S(y, left);
  for (size_t i = 0; i < left.size(); ++i)
    left[i] = r[i] - left[i];
  return greatest(left, unit) <= residual;
}

template <int D>
SummationByParts solve(scheme::PairGraph& graph,
                       const std::vector<double>& k,
                       const SummationLimits& limits) {
  SummationByParts result;
  const std::vector<double> unit = area_units(graph);
  QuadraticCorrection<D> correction(graph, k);
  result.undetermined = correction.undetermined();
  if (!result.undetermined.empty()) return result;
  const CubicPart cubic_part(graph, spacings(graph));
  std::vector<Vec3>& C = graph.C.each();
  correction.correct_rows(C);
  Field r = correction.gap(C), y;
  result.before = greatest(r, unit);
  cubic_part.remove(r);  // S keeps it out of what is left: directions are free of it
  const FieldOperator S = [&](const Field& in, Field& out) { correction.apply_S(in, out); };
  const FieldOperator inverse = [&](const Field& in, Field& out) {
    correction.precondition(in, out);
    cubic_part.remove(out);
  };
  const SolveLimits left{limits.residual, limits.iterations, patience};
  result.iterations = conjugate_gradients(
      S, inverse, [](Field&) {}, unit, left, r, y);
  if (!is_solved(S, unit, limits.residual, r, y))
    result.iterations += minimal_residuals(S, inverse, unit, left, r, y);
  correction.change(y, C);
  correction.correct_rows(C);  // of what rounding left: smooth multipliers are large
  r = correction.gap(C);
  result.after = greatest(r, unit);
  result.open = open_nodes<D>(r, unit);
  return result;
}

SummationByParts solved(scheme::PairGraph& graph,
                        const std::vector<double>& k,
                        const SummationLimits& limits) {
  return graph.dimension == 2 ? solve<2>(graph, k, limits) : solve<3>(graph, k, limits);
}

void require_met(const scheme::PairGraph& graph, const SummationByParts& result) {
  if (!result.undetermined.empty()) {
    const std::int32_t a = result.undetermined[0];
    const Vec3& X = graph.X[a];
    throw base::InputError(fmt::format(
        "node {} at ({:.6g}, {:.6g}, {:.6g}) has {} neighbours that do not determine a quadratic, "
        "which operators that sum by parts ask for: refine the mesh there",
        a, X[0], X[1], X[2], graph.row[a + 1] - graph.row[a]));
  }
  if (result.open.empty()) return;
  throw base::InputError(fmt::format(
      "operators that sum by parts: after {} iterations the adjoint misses its conditions by "
      "{:.2g} of an area; rows have {} neighbours in the mean: refine the mesh",
      result.iterations, result.after, graph.n_pairs() / graph.n_nodes()));
}

/// V_a^(1/d)/Omega_a 1/2 sum_b |C_ab|, or |C_ba| where that is more: in space 3.5 on a lattice.
constexpr double of_lattice = 3.5;

std::vector<double> slopes_of(const scheme::PairGraph& graph, const std::vector<double>& V) {
  std::vector<double> slopes(V.size());
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      double of_row = 0, of_column = 0;
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        of_row += graph.C[p].norm() / 2;
        of_column += graph.C[graph.reverse(p)].norm() / 2;
      }
      slopes[a] =
          std::max(of_row, of_column) / graph.Omega[a] * std::pow(V[a], 1.0 / graph.dimension);
    }
  });
  return slopes;
}

/// Slopes that are refused, in the plane and in space.
double steep(const scheme::PairGraph& graph) {
  return graph.dimension == 2 ? 10 : 12;
}

/// Slopes above which rows reach further, as long as the largest falls by a fiftieth each time.
double proportionate(const scheme::PairGraph& graph) {
  return graph.dimension == 2 ? 6 : 10;
}

constexpr double worth_it = 0.98;

/// Part of the rows that may stay above: corners. Where a wall is one or two cells thick, whole
/// sides do, and operators that are wider and wider in the end no longer see it bend (notes 4.5).
constexpr double most_disproportionate = 0.05;

/// The worst first.
std::vector<std::int32_t> rows_above(double bound, const std::vector<double>& slopes) {
  std::vector<std::int32_t> rows;
  for (size_t a = 0; a < slopes.size(); ++a) {
    if (slopes[a] > bound) rows.push_back(static_cast<std::int32_t>(a));
  }
  std::sort(rows.begin(), rows.end(), [&](std::int32_t a, std::int32_t b) {
    return slopes[a] != slopes[b] ? slopes[a] > slopes[b] : a < b;
  });
  return rows;
}

bool are_few(const std::vector<std::int32_t>& rows, const scheme::PairGraph& graph) {
  return static_cast<double>(rows.size()) <=
         most_disproportionate * static_cast<double>(graph.n_nodes());
}

void require_few(const std::vector<std::int32_t>& rows, const scheme::PairGraph& graph) {
  if (are_few(rows, graph)) return;
  throw base::InputError(fmt::format(
      "operators that sum by parts: weights at {} of {} nodes stay more than {:.2g} times those of "
      "a lattice however far rows reach: walls are hardly more than one cell thick there: refine "
      "them",
      rows.size(), graph.n_nodes(), proportionate(graph) / of_lattice));
}

}  // namespace

SummationByParts make_sum_by_parts(scheme::PairGraph& graph,
                                   const std::vector<double>& k,
                                   const SummationLimits& limits) {
  const SummationByParts result = solved(graph, k, limits);
  require_met(graph, result);
  repair_closure_pairs(graph, k);
  return result;
}

scheme::PairGraph summing_by_parts(const std::vector<double>& V,
                                   int most_times,
                                   const std::function<WeightedGraph()>& make,
                                   const Widen& widen) {
  scheme::PairGraph borne;  // the best so far whose rows are not steep
  double slope_of_borne = std::numeric_limits<double>::infinity();
  const auto is_any_borne = [&] { return !borne.X.empty(); };
  for (int times = 0;; ++times) {
    WeightedGraph made = make();
    scheme::PairGraph& graph = made.graph;
    const bool is_last = times == most_times;
    const SummationByParts result = solved(graph, made.k, {});
    std::vector<std::int32_t> rows =
        result.undetermined.empty() ? result.open : result.undetermined;
    if (!rows.empty()) {
      if (is_any_borne()) return borne;
      if (is_last) require_met(graph, result);
    } else {
      repair_closure_pairs(graph, made.k);
      const std::vector<double> slopes = slopes_of(graph, V);
      const double slope = *std::max_element(slopes.begin(), slopes.end());
      if (slope <= proportionate(graph)) return std::move(graph);
      if (is_any_borne() && !(slope < worth_it * slope_of_borne)) return borne;
      rows = rows_above(proportionate(graph), slopes);
      if (is_last) {
        require_no_steep_rows(graph, V);
        require_few(rows, graph);
        return std::move(graph);
      }
      if (slope <= steep(graph) && are_few(rows, graph)) {
        borne = graph;
        slope_of_borne = slope;
      }
    }
    widen(rows, graph);
  }
}

std::vector<std::int32_t> steep_rows(const scheme::PairGraph& graph, const std::vector<double>& V) {
  return rows_above(steep(graph), slopes_of(graph, V));
}

void require_no_steep_rows(const scheme::PairGraph& graph, const std::vector<double>& V) {
  const std::vector<std::int32_t> rows = steep_rows(graph, V);
  if (rows.empty()) return;
  const Vec3& X = graph.X[rows[0]];
  throw base::InputError(fmt::format(
      "operators that sum by parts: derivatives or forces at {} of {} nodes, such as {} at "
      "({:.6g}, {:.6g}, {:.6g}), have weights {:.0f} times those of a lattice, and need steps as "
      "much smaller: the mesh is too coarse there, or its cells change in size too fast: "
      "refine it, or grade it more gently",
      rows.size(), graph.n_nodes(), rows[0], X[0], X[1], X[2],
      slopes_of(graph, V)[rows[0]] / of_lattice));
}

}  // namespace diptych::closure
