#include "postprocess/report/study_report.hpp"

#include "common/base/error.hpp"
#include "postprocess/report/assets.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/sections.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace diptych::report {
namespace {

using Json = nlohmann::ordered_json;

Json run_json(const io::RunSummary& run) {
  Json errors = Json::object();
  for (const auto& [field, norms] : run.errors)
    errors[field] = norms.l2;
  return {{"level", run.level},
          {"nodes", run.nodes},
          {"spacing", run.spacing},
          {"seconds", run.loop_seconds},
          {"errors", errors}};
}

/// Energies over time as columns. "supplied" is the energy at the start and the work since.
Json history_json(const std::vector<io::HistoryRow>& rows) {
  Json columns = Json::object();
  for (const char* name :
       {"time", "kinetic", "strain", "viscous", "numerical", "supplied", "residual"}) {
    columns[name] = Json::array();
  }
  const auto total = [](const io::EnergySummary& e) {
    return e.kinetic + e.strain + e.viscous_dissipation + e.numerical_dissipation - e.external_work;
  };
  for (const io::HistoryRow& row : rows) {
    columns["time"].push_back(row.time);
    columns["kinetic"].push_back(row.energy.kinetic);
    columns["strain"].push_back(row.energy.strain);
    columns["viscous"].push_back(row.energy.viscous_dissipation);
    columns["numerical"].push_back(row.energy.numerical_dissipation);
    columns["supplied"].push_back(total(rows.front().energy) + row.energy.external_work);
    columns["residual"].push_back(row.energy.relative_residual);
  }
  return columns;
}

std::string data_json(const StudyReport& study) {
  Json methods = Json::array();
  for (const std::string& method : methods_of(study.runs)) {
    Json runs = Json::array();
    for (const io::RunSummary& run : runs_of(study.runs, method))
      runs.push_back(run_json(run));
    Json entry = {{"name", method}, {"title", method_title(method)}, {"runs", runs}};
    const auto history = study.histories.find(method);
    if (history != study.histories.end()) entry["history"] = history_json(history->second);
    methods.push_back(entry);
  }
  Json fields = Json::object();
  for (const std::string& field : fields_of(study.runs))
    fields[field] = field_title(field);
  const Json study_json = {{"methods", methods}, {"fields", fields}};
  return study_json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string report_html(const StudyReport& study, const std::string& chart_script) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n"
      "<link rel=\"icon\" "
      "href=\"data:,\">\n<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n",
      escaped(study.title), style_css);
  html += header_section(study);
  html += "<main>\n";
  html += verdict_section(study) + panels_section(study) + cost_section(study) +
          convergence_section(study) + energy_section(study) + runs_section(study) +
          provenance_section(study);
  html +=
      "</main>\n<noscript><p class=\"warning\">The charts need JavaScript; the tables do "
      "not.</p></noscript>\n";
  html += fmt::format("<script type=\"application/json\" id=\"study\">{}</script>\n",
                      json_safe(data_json(study)));
  html += "<script>" + script_safe(chart_script) + "</script>\n";
  html += "<script>" + script_safe(charts_js) + "</script>\n</body>\n</html>\n";
  return html;
}

std::string chart_script_path() {
  return DIPTYCH_CHART_JS;
}

std::string chart_script(const std::string& path) {
  if (!std::filesystem::exists(path)) {
    throw base::EnvironmentError(fmt::format(
        "reports need Chart.js, which is not at '{}': apt-get install libjs-chart.js, or "
        "build with -DDIPTYCH_CHART_JS=/path/to/chart.min.js",
        path));
  }
  std::string script = io::read_file(path);
  if (script.find("Chart.js v3.") == std::string::npos &&
      script.find("Chart.js v4.") == std::string::npos) {
    throw base::EnvironmentError(fmt::format(
        "'{}' is not Chart.js of version 3 or 4: apt-get install libjs-chart.js", path));
  }
  return script;
}

void write_report(const std::string& path, const StudyReport& study) {
  io::write_file_atomically(path, report_html(study, chart_script(chart_script_path())));
}

}  // namespace diptych::report
