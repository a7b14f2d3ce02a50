#include "postprocess/report/sections.hpp"

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/sections/parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace diptych::report {
namespace {

using io::RunSummary;

std::string order_html(double order) {
  return std::isfinite(order) ? fmt::format("{:.2f}", order) : "";
}

/// The different values among the runs, one text.
std::string distinct(const std::vector<RunSummary>& runs,
                     const std::function<std::string(const RunSummary&)>& value) {
  std::vector<std::string> values;
  for (const RunSummary& run : runs) {
    const std::string text = value(run);
    if (!text.empty() && std::find(values.begin(), values.end(), text) == values.end()) {
      values.push_back(text);
    }
  }
  return fmt::format("{}", fmt::join(values, " · "));
}

/// The first and the last day and time of the runs, which sort as text.
std::string dates(const std::vector<RunSummary>& runs) {
  std::string first, last;
  for (const RunSummary& run : runs) {
    const std::string& date = run.provenance.date;
    if (first.empty() || (!date.empty() && date < first)) first = date;
    last = std::max(last, date);
  }
  return escaped(first == last ? first : first + " to " + last);
}

std::string entry(std::string_view name, const std::string& value) {
  return value.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
}

std::string panel(const RunSummary& run, const std::vector<std::string>& fields) {
  std::string rows = entry("nodes", count_html(run.nodes));
  rows += entry("time loop", number_html(run.loop_seconds) + " s");
  rows += entry("per node and stage", number_html(run.nanoseconds_per_node_stage) + " ns");
  rows +=
      entry("per node and crossing of h", number_html(run.nanoseconds_per_node_crossing) + " ns");
  rows += entry("energy residual", scientific_html(run.energy.relative_residual));
  std::string large;
  if (!fields.empty()) {
    const io::ErrorNorms* norms = norms_of(run, fields.front());
    large =
        fmt::format("<p class=\"large\">{}<small>relative L<sub>2</sub> error of {}</small></p>\n",
                    norms == nullptr ? "n/a" : scientific_html(norms->l2),
                    escaped(field_title(fields.front())));
  } else {
    large = fmt::format("<p class=\"large\">{} s<small>in the time loop</small></p>\n",
                        number_html(run.loop_seconds));
  }
  const std::string warning =
      run.status == "done"
          ? ""
          : fmt::format("<p class=\"warning\">this run ended as: {}{}</p>\n", escaped(run.status),
                        run.unmet.empty() ? "" : " (" + escaped(run.unmet) + ")");
  return fmt::format(
      "<article {}>\n<h3>{} <small>level {}</small></h3>\n{}{}<dl>\n{}</dl>\n"
      "</article>\n",
      column_classes("panel", run.column()), column_mark(run.column()), run.level, large, warning,
      rows);
}

std::string difference_table(const StudyReport& study) {
  if (study.differences.empty()) return "";
  std::string rows;
  std::vector<std::string> fields = fields_of(study.runs);
  for (const auto& [field, value] : study.differences) {
    if (std::find(fields.begin(), fields.end(), field) == fields.end()) fields.push_back(field);
  }
  for (const std::string& field : fields) {
    const auto found = study.differences.find(field);
    if (found == study.differences.end()) continue;
    rows +=
        fmt::format("<tr><th scope=\"row\">{} <i>{}</i></th>{}</tr>\n", escaped(field_title(field)),
                    escaped(field_symbol(field)), cell(scientific_html(found->second)));
  }
  return "<h3>How far the two methods are apart</h3>\n<p>L<sub>2</sub> norm of SPH − finite "
         "volume over the nodes at the end, finest level, relative to the largest norm of the "
         "field "
         "at any output time, as the errors are.</p>\n" +
         table(heading_cell("field") + heading_cell("difference"), rows);
}

/// How far each variant is from each method, a row for either.
std::string distance_table(const StudyReport& study) {
  RunSummary apart;
  for (const ColumnDistance& one : study.distances) {
    for (const auto& [field, value] : one.fields)
      apart.errors[field].l2 = value;
  }
  const std::vector<std::string> fields = fields_of({apart});
  if (fields.empty()) return "";
  std::string head = heading_cell("variant") + heading_cell("from"), rows;
  for (const std::string& field : fields)
    head += heading_cell(field_heading(field));
  for (const ColumnDistance& one : study.distances) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th>{}", column_mark(one.column),
                        cell(column_mark(one.method)));
    for (const std::string& field : fields) {
      const auto found = one.fields.find(field);
      rows += cell(found == one.fields.end() ? "" : scientific_html(found->second));
    }
    rows += "</tr>\n";
  }
  return "<h3>How far the variants are from them</h3>\n<p>In the same norm. The verdict is on the "
         "two methods alone.</p>\n" +
         table(head, rows);
}

/// Errors of one column from coarse to fine with the order between neighbours.
std::string order_rows(const std::vector<RunSummary>& runs,
                       const std::vector<std::string>& fields) {
  std::string rows;
  for (size_t i = 0; i < runs.size(); ++i) {
    rows += "<tr>" + run_head(runs[i]) + cell(number_html(runs[i].spacing));
    for (const std::string& field : fields) {
      const io::ErrorNorms* fine = norms_of(runs[i], field);
      const io::ErrorNorms* coarse = i > 0 ? norms_of(runs[i - 1], field) : nullptr;
      rows += cell(fine == nullptr ? "" : scientific_html(fine->l2));
      rows += "<td class=\"order\">";
      if (fine != nullptr && coarse != nullptr) {
        rows +=
            order_html(observed_order(coarse->l2, fine->l2, runs[i - 1].spacing, runs[i].spacing));
      }
      rows += "</td>";
    }
    rows += "</tr>\n";
  }
  return rows;
}

}  // namespace

std::string header_section(const StudyReport& study) {
  std::string columns;
  for (const std::string& column : columns_of(study.runs)) {
    const auto settings = study.settings.find(column);
    columns += fmt::format("<li>{}{}</li>\n", column_mark(column),
                           settings == study.settings.end()
                               ? ""
                               : " <small>" + escaped(settings->second) + "</small>");
  }
  return fmt::format(
      "<header>\n<p class=\"kicker\">Diptych · {}</p>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n"
      "<ul class=\"methods\">\n{}</ul>\n{}</header>\n",
      escaped(distinct(study.runs, [](const RunSummary& run) { return run.case_name; })),
      escaped(study.title), escaped(study.description), columns, plot_hint());
}

std::string panels_section(const StudyReport& study) {
  const std::vector<std::string> fields = fields_of(study.runs);
  std::string panels;
  for (const std::string& column : columns_of(study.runs))
    panels += panel(runs_of(study.runs, column).back(), fields);
  if (panels.empty()) return section("panels", "Side by side", "<p>This study has no run.</p>\n");
  const char* const classes = columns_of(study.runs).size() > 3 ? "panels many" : "panels";
  return section("panels", "Side by side",
                 fmt::format("<div class=\"{}\">\n", classes) + panels + "</div>\n" +
                     difference_table(study) + distance_table(study));
}

std::string cost_section(const StudyReport& study) {
  const std::vector<std::string> fields = fields_of(study.runs);
  if (fields.empty()) {
    return section("cost", "Error against cost",
                   "<p>This case has no exact solution, so its runs have no errors to set against "
                   "their cost.</p>\n");
  }
  return section("cost", "Error against cost",
                 "<p>Each point is a run; its number is the level. Lower and further left is "
                 "better.</p>\n" +
                     field_choice("cost", fields) +
                     chart("cost-chart", "Relative error against seconds of the time loop", ""));
}

std::string convergence_section(const StudyReport& study) {
  const std::vector<std::string> fields = fields_of(study.runs);
  const auto columns = columns_of(study.runs);
  const bool has_levels = std::any_of(
      columns.begin(), columns.end(),
      [&](const std::string& column) { return runs_of(study.runs, column).size() > 1; });
  if (fields.empty() || !has_levels) return "";
  std::string head = heading_cell("run") + heading_cell("spacing [m]");
  for (const std::string& field : fields) {
    head += heading_cell(field_heading(field)) + heading_cell("order");
  }
  std::string rows;
  for (const std::string& column : columns)
    rows += order_rows(runs_of(study.runs, column), fields);
  return section("convergence", "Error against spacing",
                 field_choice("convergence", fields) +
                     chart("convergence-chart", "Relative error against spacing",
                           "Dotted: slopes of first and second order.") +
                     "<h3>Observed orders</h3>\n<p>Relative L<sub>2</sub> errors, and the order "
                     "between each level and the one before it.</p>\n" +
                     table(head, rows));
}

std::string energy_section(const StudyReport& study) {
  std::string charts;
  for (const std::string& column : columns_of(study.runs)) {
    if (study.histories.count(column) == 0) continue;
    charts += fmt::format("<div>\n<h3>{}</h3>\n{}</div>\n", column_mark(column),
                          chart("energy-" + escaped(column),
                                "Energies over time, " + escaped(column_title(column)), ""));
  }
  if (charts.empty()) return "";
  return section(
      "energy", "Where the energy went",
      "<p>Kinetic and strain energy, and what viscous branches and the scheme have dissipated, "
      "laid "
      "one on the other. The dashed line is the energy at the start and the work done from outside "
      "since; the gap between it and the top of the areas is the residual." +
          stride_note(study) + "</p>\n<div class=\"pair\">\n" + charts +
          "</div>\n<h3>Residual</h3>\n" +
          chart("residual-chart", "Relative energy residual over time",
                "Relative residual of the energy budget. It should fall with the time step at the "
                "order of the integrator.",
                true));
}

std::string provenance_section(const StudyReport& study) {
  const auto of = [&study](const std::function<std::string(const RunSummary&)>& value) {
    return escaped(distinct(study.runs, value));
  };
  std::string material;
  for (const std::string& line : study.material)
    material += escaped(line) + "<br>";
  std::string rows = entry("case", of([](const RunSummary& run) { return run.title; }));
  rows += entry("material", material);
  rows +=
      entry("dimensions", of([](const RunSummary& run) { return std::to_string(run.dimension); }));
  rows += entry("end time",
                of([](const RunSummary& run) { return fmt::format("{:g} s", run.end_time); }));
  rows += entry("integrator", of([](const RunSummary& run) { return run.integrator; }));
  rows += entry("precision", of([](const RunSummary& run) { return run.precision; }));
  rows += entry("threads, ranks", of([](const RunSummary& run) {
                  return fmt::format("{} × {}", run.threads, run.ranks);
                }));
  rows += entry("program", of([](const RunSummary& run) {
                  return run.provenance.version + " " + run.provenance.commit;
                }));
  rows += entry("compiler", of([](const RunSummary& run) {
                  return run.provenance.compiler + " " + run.provenance.flags;
                }));
  rows += entry("processor", of([](const RunSummary& run) {
                  return run.provenance.cpu + " " + run.provenance.instruction_set;
                }));
  rows += entry("date", dates(study.runs));
  rows += entry("case hash", of([](const RunSummary& run) { return run.provenance.case_hash; }));
  return section("provenance", "What was run", "<dl class=\"facts\">\n" + rows + "</dl>\n");
}

}  // namespace diptych::report
