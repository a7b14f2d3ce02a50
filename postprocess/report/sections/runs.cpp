/// Every run of the study: what it took, what it gave, which operators it had. Three tables, since
/// one would be wider than most screens.

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/sections/parts.hpp"

#include <fmt/format.h>

namespace diptych::report {
namespace {

using io::RunSummary;

std::string cost_row(const RunSummary& run) {
  return "<tr>" + run_head(run) + cell(count_html(run.nodes)) + cell(count_html(run.pairs)) +
         cell(run.rejected_steps > 0 ? fmt::format("{} ({} rejected)", count_html(run.steps),
                                                   count_html(run.rejected_steps))
                                     : count_html(run.steps)) +
         cell(scientific_html(run.dt_min)) + cell(number_html(run.loop_seconds)) +
         cell(number_html(run.wall_seconds)) + cell(number_html(run.nanoseconds_per_node_stage)) +
         cell(number_html(static_cast<double>(run.peak_rss_bytes) / 1e6)) + "</tr>\n";
}

/// Cells of whole sentences, which may break.
std::string text_cell(const std::string& content) {
  return "<td class=\"words\">" + content + "</td>";
}

std::string text_heading_cell(const std::string& content) {
  return "<th scope=\"col\" class=\"words\">" + content + "</th>";
}

std::string operators_row(const RunSummary& run) {
  std::string notices;
  for (const std::string& notice : run.notices)
    notices += (notices.empty() ? "" : "<br>") + escaped(notice);
  return "<tr>" + run_head(run) + text_cell(escaped(run.graph_operators)) + text_cell(notices) +
         "</tr>\n";
}

std::string result_row(const RunSummary& run, const std::vector<std::string>& fields) {
  std::string row = "<tr>" + run_head(run);
  for (const std::string& field : fields) {
    const io::ErrorNorms* norms = norms_of(run, field);
    row += cell(norms == nullptr ? "" : scientific_html(norms->l2));
  }
  row += cell(scientific_html(run.energy.relative_residual)) + cell(number_html(run.min_jacobian));
  row += cell(run.inverted_from ? fmt::format("<strong>{}</strong> (inside out from {:.3g} s)",
                                              number_html(run.least_cell_J), *run.inverted_from)
                                : number_html(run.least_cell_J));
  return row + cell(escaped(run.status)) + "</tr>\n";
}

}  // namespace

std::string runs_section(const StudyReport& study) {
  const std::vector<std::string> fields = fields_of(study.runs);
  std::string cost_head = heading_cell("run"), result_head = cost_head, costs, results, operators;
  const std::string operators_head =
      cost_head + text_heading_cell("operators") + text_heading_cell("what was said of them");
  for (const char* name : {"nodes", "pairs", "steps", "time step [s]", "loop [s]", "wall [s]",
                           "ns / node / stage", "memory [MB]"}) {
    cost_head += heading_cell(name);
  }
  for (const std::string& field : fields)
    result_head += heading_cell("error " + field_heading(field));
  for (const char* name : {"energy residual", "min <i>J</i>", "min <i>J</i> of cells", "status"}) {
    result_head += heading_cell(name);
  }
  for (const std::string& column : columns_of(study.runs)) {
    for (const RunSummary& run : runs_of(study.runs, column)) {
      costs += cost_row(run);
      results += result_row(run, fields);
      operators += operators_row(run);
    }
  }
  return section("runs", "Every run",
                 "<h3>What it took</h3>\n" + table(cost_head, costs) +
                     "<p class=\"hint\">Memory: the most that the run had of the machine at any "
                     "instant, from reading its mesh to its end.</p>\n<h3>What it gave</h3>\n" +
                     table(result_head, results) + "<h3>What it ran on</h3>\n" +
                     table(operators_head, operators));
}

}  // namespace diptych::report
