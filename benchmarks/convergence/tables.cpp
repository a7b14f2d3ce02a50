/// The forms that a study of refinement is written in.

#include "benchmarks/convergence/convergence.hpp"
#include "postprocess/report/orders.hpp"

#include <cmath>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

std::string titled(const Quantity& quantity) {
  return quantity.unit == "-" ? quantity.name : quantity.name + " [" + quantity.unit + "]";
}

/// Seven digits: enough to see what the third grid changes.
std::string value_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.7g}", value) : "-";
}
std::string order_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.2f}", value) : "-";
}
std::string short_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.1e}", value) : "-";
}
std::string percent(double fraction) {
  return std::isfinite(fraction) ? fmt::format("{:.2g} %", 100 * fraction) : "-";
}

/// What stands in a row of scalars, of the finest levels.
struct ScalarRow {
  std::string finest, extrapolated = "-", order = "-", index = "-", bar = "-", remark;
};

ScalarRow row_of(const MethodConvergence& study, const Quantity& quantity) {
  const size_t last = quantity.values.size() - 1;
  ScalarRow row;
  row.finest = value_text(quantity.values[last]);
  if (const auto g = estimate(study, quantity, last)) {
    row.extrapolated = value_text(g->extrapolated);
    row.order = order_text(g->order);
    row.index = percent(g->index);
    row.bar = short_text(g->error_bar);
    if (g->kind != report::Convergence::monotone) row.remark = report::convergence_name(g->kind);
  } else if (const double bar = error_bar(study, quantity); std::isfinite(bar)) {
    row.bar = short_text(bar);
    row.index = quantity.values[1] != 0 ? percent(bar / std::abs(quantity.values[1])) : "-";
    row.remark = "two grids";
  }
  return row;
}

/// RFC 4180.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}
std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "";
}

/// Text for LaTeX: special characters escaped, m^2 as m$^{2}$.
std::string tex(const std::string& text) {
  std::string result;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '^' && i + 1 < text.size()) {
      result += fmt::format("$^{{{}}}$", text[++i]);
    } else if (c == '\\' || c == '~' || c == '^') {
      result += fmt::format("{{\\char{}}}", static_cast<int>(c));
    } else {
      if (std::string("_%&#${}").find(c) != std::string::npos) result += '\\';
      result += c;
    }
  }
  return result;
}

/// 1.2e-03 as $1.2\cdot10^{-3}$.
std::string tex_number(const std::string& text) {
  const size_t e = text.find('e');
  if (e == std::string::npos || text == "-") return text == "-" ? "--" : text;
  return fmt::format("${}\\cdot10^{{{}}}$", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

std::string tex_errors(const MethodConvergence& study) {
  std::vector<const Quantity*> columns;
  for (const Quantity& error : study.errors) {
    if (error.name.ends_with(" L2")) columns.push_back(&error);
  }
  if (columns.empty()) return "";
  std::string text = fmt::format("% {}, {}: relative L2 errors and observed orders\n",
                                 report::method_title(study.method), study.case_name);
  text += "\\begin{tabular}{rr";
  for (size_t i = 0; i < columns.size(); ++i)
    text += "rr";
  text += "}\n\\hline\n$h$ [m] & nodes";
  for (const Quantity* column : columns)
    text += " & " + tex(column->name.substr(0, column->name.size() - 9)) + " [-] & order [-]";
  text += " \\\\\n\\hline\n";
  for (size_t i = 0; i < study.levels.size(); ++i) {
    text += fmt::format("{} & {}", tex_number(fmt::format("{:.4g}", study.levels[i].spacing)),
                        study.levels[i].nodes);
    for (const Quantity* column : columns) {
      const double e = column->values[i];
      text +=
          fmt::format(" & {} & {}", std::isfinite(e) ? tex_number(fmt::format("{:.2e}", e)) : "--",
                      tex_number(order_text(order_of_error(study, *column, i))));
    }
    text += " \\\\\n";
  }
  return text + "\\hline\n\\end{tabular}\n";
}

std::string tex_scalars(const MethodConvergence& study) {
  if (study.scalars.empty()) return "";
  std::string text =
      fmt::format("% {}, {}: values at the end, extrapolated from the finest grids\n",
                  report::method_title(study.method), study.case_name);
  text +=
      "\\begin{tabular}{lrrrrrl}\n\\hline\nquantity [unit] & finest grid & extrapolated & "
      "order [-] & index [\\%] & error bar & \\\\\n\\hline\n";
  for (const Quantity& quantity : study.scalars) {
    const ScalarRow row = row_of(study, quantity);
    std::string index = row.index;
    if (index.ends_with(" %")) index.resize(index.size() - 2);
    text += fmt::format("{} & {} & {} & {} & {} & {} & {} \\\\\n", tex(titled(quantity)),
                        tex_number(row.finest), tex_number(row.extrapolated), tex_number(row.order),
                        tex_number(index), tex_number(row.bar), row.remark);
  }
  return text + "\\hline\n\\end{tabular}\n";
}

}  // namespace

std::string quantity_table(const MethodConvergence& study) {
  if (study.scalars.empty()) return "";
  std::string text = fmt::format("{}, {}: values at the end, extrapolated from the finest levels\n",
                                 report::method_title(study.method), study.case_name);
  const auto line = [&](const std::string& name, const ScalarRow& row) {
    std::string cells =
        fmt::format("{:<33}{:>14}{:>14}{:>7}{:>10}{:>10}  {}", name.substr(0, 33), row.finest,
                    row.extrapolated, row.order, row.index, row.bar, row.remark);
    cells.erase(cells.find_last_not_of(' ') + 1);
    text += cells + "\n";
  };
  line("quantity", {"finest", "extrapolated", "order", "GCI", "error bar", ""});
  text += std::string(100, '-') + "\n";
  for (const Quantity& quantity : study.scalars)
    line(titled(quantity), row_of(study, quantity));
  if (!study.zero.empty())
    text += fmt::format("zero on every level: {}\n", fmt::join(study.zero, ", "));
  return text;
}

std::string convergence_csv(const std::vector<MethodConvergence>& studies) {
  std::string text =
      "method,quantity,unit,level,spacing [m],nodes,steps,value,order,extrapolated,error bar,"
      "GCI,convergence\n";
  for (const MethodConvergence& study : studies) {
    for (const auto* group : {&study.errors, &study.scalars}) {
      for (const Quantity& quantity : *group) {
        for (size_t i = 0; i < study.levels.size(); ++i) {
          const auto& run = study.levels[i];
          text += fmt::format("{},{},{},{},{:.17g},{},{},{}", csv_cell(study.method),
                              csv_cell(quantity.name), csv_cell(quantity.unit), run.level,
                              run.spacing, run.nodes, run.steps, csv_number(quantity.values[i]));
          if (quantity.is_error) {
            text += fmt::format(",{},,,,\n", csv_number(order_of_error(study, quantity, i)));
          } else if (const auto g = estimate(study, quantity, i)) {
            text += fmt::format(",{},{},{},{},{}\n", csv_number(g->order),
                                csv_number(g->extrapolated), csv_number(g->error_bar),
                                csv_number(g->index), report::convergence_name(g->kind));
          } else {
            text += ",,,,,\n";
          }
        }
      }
    }
  }
  return text;
}

std::string convergence_tex(const std::vector<MethodConvergence>& studies) {
  std::string text;
  for (const MethodConvergence& study : studies) {
    for (const std::string& part : {tex_errors(study), tex_scalars(study)}) {
      if (!part.empty()) text += (text.empty() ? "" : "\n") + part;
    }
  }
  return text;
}

}  // namespace diptych::harness
