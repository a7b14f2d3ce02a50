#include "common/closure/summation_by_parts.hpp"

#include "common/base/error.hpp"
#include "common/closure/closure_gap.hpp"
#include "common/closure/closure_repair.hpp"
#include "common/closure/cubic_part.hpp"
#include "common/closure/quadratic_correction.hpp"

#include <fmt/format.h>

namespace diptych::closure {

namespace {

/// A residual that is left in the end and still does no harm beside the error of the scheme.
constexpr double most_residual = 1e-3;

template <int D>
SummationByParts solve(scheme::PairGraph& graph,
                       const std::vector<double>& k,
                       const SummationLimits& limits) {
  SummationByParts result;
  const std::vector<double> unit = area_units(graph);
  QuadraticCorrection<D> correction(graph, k);
  const CubicPart cubic_part(graph, spacings(graph));
  correction.correct_rows(graph.C);
  Field r = correction.gap(graph.C), y;
  result.before = greatest(r, unit);
  cubic_part.remove(r);  // S keeps it out of what is left: directions are free of it
  const SolveLimits left{limits.residual, limits.iterations, limits.iterations};
  result.iterations =
      conjugate_gradients([&](const Field& in, Field& out) { correction.apply_S(in, out); },
                          [&](const Field& in, Field& out) {
                            correction.precondition(in, out);
                            cubic_part.remove(out);
                          },
                          [](Field&) {}, unit, left, r, y);
  correction.change(y, graph.C);
  correction.correct_rows(graph.C);  // of what rounding left: smooth multipliers are large
  result.after = greatest(correction.gap(graph.C), unit);
  return result;
}

}  // namespace

SummationByParts make_sum_by_parts(scheme::PairGraph& graph,
                                   const std::vector<double>& k,
                                   const SummationLimits& limits) {
  const SummationByParts result =
      graph.dimension == 2 ? solve<2>(graph, k, limits) : solve<3>(graph, k, limits);
  if (!(result.after <= most_residual)) {
    throw base::InputError(fmt::format(
        "operators that sum by parts: after {} iterations the adjoint misses its conditions by "
        "{:.2g} of an area; rows have {} neighbours in the mean: raise sph.kappa, or use gradient "
        "= "
        "\"corrected\" (SPH), stencil = \"edge\" (finite volumes)",
        result.iterations, result.after, graph.n_pairs() / graph.n_nodes()));
  }
  repair_closure_pairs(graph, k);
  return result;
}

}  // namespace diptych::closure
