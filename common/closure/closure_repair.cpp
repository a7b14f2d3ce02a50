#include "common/closure/closure_repair.hpp"

#include "common/closure/closure_gap.hpp"
#include "common/closure/conjugate_gradients.hpp"
#include "common/closure/pair_correction.hpp"

namespace diptych::closure {

namespace {

constexpr int most_passes = 4;

}  // namespace

/// Solves for the gap and applies the correction, again for what round-off left, as long as that
/// halves it. A graph without a gap, such as that of a box of cells, makes no correction at all.
ClosureRepair repair_closure_pairs(scheme::PairGraph& graph,
                                   const std::vector<double>& k,
                                   const RepairLimits& limits) {
  ClosureRepair result;
  const std::vector<double> unit = area_units(graph);
  Field gap = closure_gap(graph), y;
  result.before = result.after = greatest(gap, unit);
  if (result.before <= limits.closure) return result;
  PairCorrection correction(graph, k);
  const AffinePart affine_part(graph.X);
  const NullPart remove_affine_part = [&](Field& r) { affine_part.remove(r); };
  const FieldOperator S = [&](const Field& in, Field& out) { correction.apply_S(in, out); };
  const FieldOperator inverse = [&](const Field& r, Field& z) { correction.precondition(r, z); };
  for (int pass = 0; pass < most_passes && !(result.after <= limits.closure); ++pass) {
    const SolveLimits left{0.5 * limits.closure, limits.iterations - result.iterations};
    result.iterations += conjugate_gradients(S, inverse, remove_affine_part, unit, left, gap, y);
    std::vector<Vec3>& C = graph.C.each();
    std::vector<Vec3> C_before = C;
    correction.change(y, C);
    gap = closure_gap(graph);
    const double before = result.after, after = greatest(gap, unit);
    if (!(after < before)) {
      C.swap(C_before);
      break;
    }
    result.after = after;
    if (after > 0.5 * before) break;
  }
  return result;
}

}  // namespace diptych::closure
