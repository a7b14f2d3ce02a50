/// The results of a work-precision study as text, CSV and a page.

#include "benchmarks/probes/work_counts.hpp"
#include "benchmarks/study/work_precision.hpp"
#include "benchmarks/terminal/text.hpp"
#include "postprocess/report/curve_page.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/line_plot.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/study_report.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// Width of the column of curve names.
size_t name_width(const std::vector<WorkCurve>& curves) {
  size_t width = 5;
  for (const WorkCurve& curve : curves)
    width = std::max(width, curve.name().size());
  return width;
}

/// Share of the multiply-add peak of as many threads, counted work only  [%].
double share_of_peak(const WorkPoint& point, const probes::MachineProbes& machine) {
  const auto work = probes::stage_work(point.run.dimension, point.face_correction != 0);
  const double peak = point.run.threads == 1 ? machine.double_one.flops : machine.double_all.flops;
  return 100 * work.flop * point.pair_updates() / (point.least * peak);
}

std::string range_text(const Range& range) {
  if (!std::isfinite(range.least) && !std::isfinite(range.most)) return "-";
  if (!std::isfinite(range.least)) return fmt::format("{:.3g}", range.most);
  if (!std::isfinite(range.most)) return fmt::format("{:.3g}", range.least);
  return fmt::format("{:.3g} to {:.3g}", range.least, range.most);
}

std::string level_rows(const std::vector<WorkCurve>& curves,
                       const std::string& field,
                       const probes::MachineProbes& machine) {
  const size_t width = name_width(curves);
  const std::string head =
      fmt::format("{:<{}}{:>6}{:>9}{:>11}{:>10}{:>8}{:>10}{:>7}{:>11}", "", width, "level", "nodes",
                  "pair upd.", "loop [s]", "spread", "ns/n/st", "% fma", "error");
  std::string text = head + "\n" + std::string(head.size(), '-') + "\n";
  for (const WorkCurve& curve : curves) {
    for (const WorkPoint& p : curve.points) {
      text += fmt::format("{:<{}}{:>6}{:>9}{:>11.3g}{:>10.3g}{:>7.0f}%{:>10.0f}{:>7.1f}{:>11.3e}\n",
                          curve.name(), width, p.run.level, p.run.nodes, p.pair_updates(), p.least,
                          100 * (p.most / p.least - 1), p.run.nanoseconds_per_node_stage,
                          share_of_peak(p, machine), p.error(field));
    }
  }
  return text;
}

/// A block of ranges: a column for every value, a row for every curve.
std::string range_rows(const std::vector<WorkCurve>& curves,
                       const std::string& field,
                       bool at_cost) {
  const std::vector<double> values = common_values(curves, field, at_cost, 3);
  if (values.empty()) {
    return fmt::format("the curves have no {} in common: add levels\n", at_cost ? "cost" : "error");
  }
  const size_t width = name_width(curves);
  std::string text = fmt::format("{:<{}}", "", width);
  for (const double value : values)
    text += fmt::format("{:>22}",
                        at_cost ? fmt::format("{:.3g} s", value) : fmt::format("{:.3e}", value));
  text += "\n";
  for (const WorkCurve& curve : curves) {
    text += fmt::format("{:<{}}", curve.name(), width);
    for (const double value : values) {
      text += fmt::format("{:>22}", range_text(at_cost ? error_at_cost(curve, field, value)
                                                       : cost_at_error(curve, field, value)));
    }
    text += "\n";
  }
  return text;
}

/// SPH against FVM of the same variant.
std::string crossover_lines(const std::vector<WorkCurve>& curves, const std::string& field) {
  std::string text;
  for (const WorkCurve& a : curves) {
    for (const WorkCurve& b : curves) {
      if (a.variant != b.variant || a.method != "sph" || b.method != "fvm") continue;
      const std::string names = a.name() + " and FVM";
      if (const auto meet = crossover(a, b, field)) {
        text += fmt::format("{}: cost the same at error {:.2e}, {:.3g} s\n", names, meet->error,
                            meet->seconds);
        continue;
      }
      const auto errors = common_values({a, b}, field, false, 2);
      if (errors.empty()) {
        text += names + ": reach no error in common\n";
        continue;
      }
      const double coarse =
          cost_at_error(a, field, errors[1]).least / cost_at_error(b, field, errors[1]).least;
      const double fine =
          cost_at_error(a, field, errors[0]).least / cost_at_error(b, field, errors[0]).least;
      text +=
          fmt::format("{}: no crossover; SPH / FVM cost {:.2g} at error {:.2e}, {:.2g} at {:.2e}\n",
                      names, coarse, errors[1], fine, errors[0]);
    }
  }
  return text;
}

report::Panel panel_of(const std::vector<WorkCurve>& curves,
                       const std::string& field,
                       const std::string& x_label,
                       double (*x)(const WorkPoint&)) {
  report::Panel panel;
  panel.title = "Error against " + x_label;
  panel.x_label = x_label;
  panel.y_label = "relative L2 error";
  panel.logarithmic = true;
  for (const WorkCurve& curve : curves) {
    report::Curve line;
    line.name = curve.name();
    for (const WorkPoint& point : curve.points) {
      line.x.push_back(x(point));
      line.y.push_back(point.error(field));
    }
    panel.curves.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

std::string work_precision_table(const std::vector<WorkCurve>& curves,
                                 const std::string& field,
                                 const probes::MachineProbes& machine) {
  std::string text = probes::probes_text(machine);
  text += fmt::format(
      "\nerror: relative L2 of {}; % fma: flop of the pair sweeps as a share of the peak\n",
      report::field_title(field));
  text += level_rows(curves, field, machine);
  text += "\nseconds at equal error, least to most of the repetitions\n" +
          range_rows(curves, field, false);
  text += "\nerror at equal seconds\n" + range_rows(curves, field, true);
  const std::string meetings = crossover_lines(curves, field);
  return text + (meetings.empty() ? "" : "\n" + meetings);
}

std::string work_precision_csv(const std::vector<WorkCurve>& curves) {
  std::vector<io::RunSummary> runs;
  for (const WorkCurve& curve : curves) {
    for (const WorkPoint& point : curve.points)
      runs.push_back(point.run);
  }
  const std::vector<std::string> fields = report::fields_of(runs);
  std::string csv =
      "variant,method,level,spacing [m],nodes,pairs,steps,stages,pair updates,seconds least [s],"
      "seconds most [s],ns per node and stage [ns]";
  for (const std::string& field : fields)
    csv += ",error " + field + " [-]";
  csv += "\n";
  for (const WorkCurve& curve : curves) {
    for (const WorkPoint& p : curve.points) {
      csv += fmt::format("{},{},{},{:.8g},{},{},{},{},{:.10g},{:.6g},{:.6g},{:.6g}",
                         quoted(curve.variant), curve.method, p.run.level, p.run.spacing,
                         p.run.nodes, p.run.pairs, p.run.steps, p.run.stages, p.pair_updates(),
                         p.least, p.most, p.run.nanoseconds_per_node_stage);
      for (const std::string& field : fields)
        csv += fmt::format(",{:.8g}", p.error(field));
      csv += "\n";
    }
  }
  return csv;
}

std::string work_precision_html(const std::string& title,
                                const std::vector<WorkCurve>& curves,
                                const std::string& field,
                                const probes::MachineProbes& machine) {
  return report::curve_page(
      title,
      fmt::format("Error of {} against cost, both methods; lower and further left is better.",
                  report::field_title(field)),
      work_precision_verdict(curves, field),
      {panel_of(curves, field, "seconds", [](const WorkPoint& p) { return p.least; }),
       panel_of(curves, field, "nodes",
                [](const WorkPoint& p) { return static_cast<double>(p.run.nodes); }),
       panel_of(curves, field, "pair updates",
                [](const WorkPoint& p) { return p.pair_updates(); })},
      work_precision_table(curves, field, machine),
      report::chart_script(report::chart_script_path()));
}

}  // namespace diptych::harness
