#include "benchmarks/run/run_table.hpp"

#include "benchmarks/terminal/reference_table.hpp"
#include "common/base/text.hpp"

#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// Six digits; the least of no values is 1e300.
std::string least_text(double J) {
  return J < 1e299 ? fmt::format("{:.6g}", J) : "not measured";
}

/// "tip deflection: 1.25 m at the end, -0.1 to 1.3; period 0.65 s, ..."
std::string quantity_line(const io::QuantitySummary& q) {
  const std::string unit = q.unit == "-" ? "" : " " + q.unit;
  std::string line = fmt::format("{}: {:.6g}{} at the end, {:.6g} to {:.6g}", q.name, q.final_value,
                                 unit, q.least, q.greatest);
  if (q.n_periods > 0) {
    line +=
        fmt::format("; period {:.6g} s ({}), amplitude {:.4g}", q.period, q.n_periods, q.amplitude);
  }
  if (q.decrement) line += fmt::format(", decrement {:.3g}", *q.decrement);
  return line;
}

}  // namespace

std::string inverted_cells_warning(const io::RunSummary& s) {
  if (!s.inverted_from) return "";
  return fmt::format(
      "  WARNING: {} level {}: from t = {:.4g} s on cells are inside out (up to {}, least cell J "
      "{:.3g}):\n  the body has passed through itself between nodes, or they are too coarse or too "
      "thin for the "
      "motion; do not use what comes after\n",
      s.column(), s.level, *s.inverted_from, s.most_inverted_cells, s.least_cell_J);
}

std::string run_table(const io::RunSummary& s, const ReferenceTimes& times) {
  std::string text =
      fmt::format("{} level {}: {} nodes, {} pairs ({:.3g} a node), {} unknowns a node{}\n",
                  s.column(), s.level, s.nodes, s.pairs, s.mean_neighbours, s.unknowns_per_node,
                  s.volumes == "nodes" ? "" : ", volumes of " + s.volumes);
  if (!s.graph_operators.empty()) text += fmt::format("  {}\n", s.graph_operators);
  text += fmt::format(
      "  {} steps of {}, dt {:.3g} to {:.3g} s; {:.3g} s in the loop of {:.3g} s with set-up and "
      "output, {:.3g} ns per node and stage ({}{} {})\n",
      s.steps, s.integrator, s.dt_min, s.dt_max, s.loop_seconds, s.wall_seconds,
      s.nanoseconds_per_node_stage, s.ranks == 1 ? "" : fmt::format("{} ranks of ", s.ranks),
      s.threads, s.threads == 1 ? "thread" : "threads");
  if (s.ranks > 1) {
    text += fmt::format(
        "  ranks: largest work {:.3g} of the mean, {:.3g} s in communication, {:.3g} MB from rank "
        "to rank\n",
        s.imbalance, s.communication_seconds, 1e-6 * static_cast<double>(s.exchanged_bytes));
  }
  if (s.rejected_steps > 0) {
    text += fmt::format("  {} {} rejected and made again with half the size\n", s.rejected_steps,
                        s.rejected_steps == 1 ? "attempt at a step was" : "attempts at steps were");
  }
  if (s.projections > 0)
    text += fmt::format("  angular momentum projected {} times\n", s.projections);
  if (s.limited_pairs > 0) {
    const double all = 0.5 * static_cast<double>(s.pairs) * static_cast<double>(s.stages);
    text += fmt::format("  the limiter changed {:.3g} % of the jumps by 1 % and more\n",
                        100 * static_cast<double>(s.limited_pairs) / all);
  }
  if (s.restarts > 0) {
    text += fmt::format("  went on from a checkpoint {} {}\n", s.restarts,
                        s.restarts == 1 ? "time" : "times");
  }
  if (!s.errors.empty()) {
    text += "  relative L2 errors:";
    for (const auto& [name, norms] : s.errors)
      text += fmt::format("  {} {:.3e}", name, norms.l2);
    text += "\n";
  }
  text += fmt::format(
      "  energy: kinetic {:.4g}, strain {:.4g}, work {:.4g}, viscous {:.4g}, numerical {:.4g}",
      s.energy.kinetic, s.energy.strain, s.energy.external_work, s.energy.viscous_dissipation,
      s.energy.numerical_dissipation);
  if (s.contact_loss != 0) text += fmt::format(", caught by walls {:.4g}", s.contact_loss);
  if (s.energy.projection_work != 0)
    text += fmt::format(", projection {:.4g}", s.energy.projection_work);
  text += fmt::format(" J; residual {:.1e}\n", s.energy.relative_residual);
  for (const io::QuantitySummary& quantity : s.quantities)
    text += "  " + quantity_line(quantity) + "\n";
  for (const io::ReferenceSummary& one : s.references) {
    text += fmt::format("  {} against {}: off by at most {:.3g} (at {:.4g} s), {}\n", one.name,
                        one.source, one.greatest, one.greatest_at,
                        uncertainty_verdict(one, s.end_time, times));
  }
  text += fmt::format("  status {}, least J {} (cells {}), state {}\n", s.status,
                      least_text(s.min_jacobian), least_text(s.least_cell_J), s.state_hash);
  return base::folded(text + inverted_cells_warning(s), 4);
}

}  // namespace diptych::harness
