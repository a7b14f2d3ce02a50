#include "postprocess/report/study_report.hpp"

#include "common/base/error.hpp"
#include "postprocess/report/assets.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/price.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/sections/parts.hpp"

#include <algorithm>
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

/// A column of history.csv that the exact solution of a case may have as well.
std::optional<double> value_of(const io::HistoryRow& row, const std::string& column) {
  if (column == "kinetic energy") return row.energy.kinetic;
  for (size_t i = 0; i < 3; ++i) {
    if (column == std::string("linear momentum ") + "xyz"[i]) return row.linear_momentum[i];
  }
  return std::nullopt;
}

/// Energies in joule and probes over time as columns. "supplied" is the energy at the start and the
/// work since, that of the projection too; "residual" what of it is not accounted for.
Json history_json(const std::vector<io::HistoryRow>& rows,
                  const std::vector<io::HistoryColumn>& others) {
  Json columns = Json::object();
  for (const char* name : {"time", "kinetic", "strain", "viscous", "numerical", "work",
                           "projection", "supplied", "residual", "relative"}) {
    columns[name] = Json::array();
  }
  columns["probes"] = Json::array();
  columns["others"] = Json::array();
  const auto accounted = [](const io::EnergySummary& e) {
    return e.kinetic + e.strain + e.viscous_dissipation + e.numerical_dissipation;
  };
  const size_t stride = row_stride(rows.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    if (i % stride != 0 && i + 1 != rows.size()) continue;
    const io::HistoryRow& row = rows[i];
    const io::EnergySummary &e = row.energy, &start = rows.front().energy;
    const double supplied = accounted(start) - start.external_work - start.projection_work +
                            e.external_work + e.projection_work;
    columns["time"].push_back(row.time);
    columns["kinetic"].push_back(e.kinetic);
    columns["strain"].push_back(e.strain);
    columns["viscous"].push_back(e.viscous_dissipation);
    columns["numerical"].push_back(e.numerical_dissipation);
    columns["work"].push_back(e.external_work);
    columns["projection"].push_back(e.projection_work);
    columns["supplied"].push_back(supplied);
    columns["residual"].push_back(accounted(e) - supplied);
    columns["relative"].push_back(e.relative_residual);
    for (size_t k = 0; k < row.probes.size(); ++k)
      columns["probes"][k].push_back(row.probes[k]);
    for (size_t k = 0; k < others.size(); ++k)
      columns["others"][k].push_back(*value_of(row, others[k].name));
  }
  return columns;
}

/// Names and units of the probes.
Json probes_json(const StudyReport& study) {
  Json probes = Json::array();
  const auto runs = probed_runs(study);
  if (runs.empty()) return probes;
  for (const io::QuantitySummary& quantity : runs.front().quantities)
    probes.push_back({{"name", quantity.name}, {"unit", quantity.unit}});
  return probes;
}

/// The exact solution at the instants of the curves: null where there is none.
Json exact_json(const StudyReport& study) {
  const std::vector<io::HistoryColumn>& columns = study.references.exact;
  if (columns.empty()) return nullptr;
  const size_t n_rows = columns.front().values.size(), stride = row_stride(n_rows);
  const auto values = [&](const io::HistoryColumn& column) {
    Json kept = Json::array();
    for (size_t i = 0; i < n_rows; ++i) {
      if (i % stride == 0 || i + 1 == n_rows) kept.push_back(column.values.at(i));
    }
    return kept;
  };
  Json probes = Json::object(), others = Json::array();
  for (const io::HistoryColumn& other : exact_others(study))
    others.push_back({{"name", other.name}, {"unit", other.unit}, {"values", values(other)}});
  for (const io::HistoryColumn& column : columns) {
    if (column.name != "time") probes[column.name] = values(column);
  }
  return {{"time", values(columns.front())}, {"probes", probes}, {"others", others}};
}

Json references_json(const StudyReport& study) {
  Json references = Json::array();
  for (const ReferencePoints& one : study.references.points)
    references.push_back({{"probe", one.probe}, {"points", one.points}});
  return references;
}

Json quantities_json(const StudyReport& study) {
  Json quantities = Json::array();
  for (const auto& [quantity, series] : study.quantities) {
    Json all = Json::array();
    for (const GridSeries& one : series) {
      Json points = Json::array();
      for (const GridPoint& p : one.points) {
        points.push_back(
            {{"level", p.level}, {"spacing", p.spacing}, {"value", p.value}, {"bar", p.error_bar}});
      }
      Json entry = {{"method", one.column}, {"points", points}};
      if (one.estimate) entry["extrapolated"] = one.estimate->extrapolated;  // NaN becomes null
      all.push_back(entry);
    }
    quantities.push_back({{"name", quantity.first}, {"unit", quantity.second}, {"series", all}});
  }
  return quantities;
}

/// What the same error costs by either method; an entry for each field in which both reach one.
Json prices_json(const StudyReport& study) {
  Json prices = Json::object();
  const auto methods = methods_of(study.runs);
  if (methods.size() != 2) return prices;
  for (const std::string& field : fields_of(study.runs)) {
    const auto price =
        price_of_error(runs_of(study.runs, methods[0]), runs_of(study.runs, methods[1]), field);
    if (!price) continue;
    prices[field] = {{"error", price->error},
                     {"seconds", {{methods[0], price->first}, {methods[1], price->second}}}};
  }
  return prices;
}

/// The methods and their variants; a variant says whose it is.
Json columns_json(const StudyReport& study) {
  Json columns = Json::array();
  for (const std::string& column : columns_of(study.runs)) {
    Json runs = Json::array();
    for (const io::RunSummary& run : runs_of(study.runs, column))
      runs.push_back(run_json(run));
    Json entry = {{"name", column}, {"title", column_title(column)}, {"runs", runs}};
    if (method_of_column(column) != column) entry["method"] = method_of_column(column);
    const auto history = study.histories.find(column);
    if (history != study.histories.end()) {
      entry["history"] = history_json(history->second, exact_others(study));
    }
    columns.push_back(entry);
  }
  return columns;
}

std::string data_json(const StudyReport& study) {
  const Json methods = columns_json(study);
  Json fields = Json::object();
  for (const std::string& field : fields_of(study.runs))
    fields[field] = field_title(field);
  const Json study_json = {{"case", study.runs.empty() ? "" : study.runs.front().case_name},
                           {"methods", methods},
                           {"fields", fields},
                           {"prices", prices_json(study)},
                           {"probes", probes_json(study)},
                           {"exact", exact_json(study)},
                           {"references", references_json(study)},
                           {"quantities", quantities_json(study)},
                           {"shapes", shapes_json(study.shapes)}};
  return study_json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::vector<io::HistoryColumn> exact_others(const StudyReport& study) {
  std::vector<io::HistoryColumn> others;
  for (const io::HistoryColumn& column : study.references.exact) {
    if (!value_of({}, column.name)) continue;
    const auto is_same = [&](const io::HistoryColumn& one) { return one.name == column.name; };
    if (std::none_of(others.begin(), others.end(), is_same)) others.push_back(column);
  }
  return others;
}

std::string report_html(const StudyReport& study, const std::string& chart_script) {
  std::string html = page_head(study.title, variant_styles(columns_of(study.runs)));
  html += header_section(study);
  html += "<main>\n";
  html += verdict_section(study) + panels_section(study) + shapes_section(study) +
          probes_section(study) + cost_section(study) + convergence_section(study) +
          quantities_section(study) + energy_section(study) + runs_section(study) +
          provenance_section(study);
  return html + "</main>\n" + page_scripts(data_json(study), chart_script, page_js);
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
