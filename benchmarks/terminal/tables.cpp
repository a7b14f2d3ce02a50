#include "benchmarks/terminal/tables.hpp"

#include "benchmarks/terminal/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {
namespace {

using io::RunSummary;
using report::error_of;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr size_t columns_per_block = 5;  // of 14 columns each, after 30 for the name
constexpr size_t fields_per_block = 4;   // of 15 columns each, after 38 for the level

/// Three digits, as a decimal where that is short: 0.0594, 1.07, 452, 1.23e-04.
std::string number(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size != 0 && (size < 0.00995 || size >= 99999.5)) return fmt::format("{:.2e}", value);
  const int decimals = size >= 99.95    ? 0
                       : size >= 9.995  ? 1
                       : size >= 0.9995 ? 2
                       : size > 0       ? 4
                                        : 0;
  return fmt::format("{:.{}f}", value, decimals);
}

std::string scientific(double value) {
  return number_text(value, "{:.2e}");
}

std::string ratio(double sph, double fvm) {
  return fvm != 0 && std::isfinite(sph) && std::isfinite(fvm) ? number(sph / fvm) : "-";
}

/// "v", or the name of a field without a symbol, cut to the width of its column.
std::string short_name(const std::string& field, size_t width) {
  const std::string symbol = report::field_symbol(field);
  return symbol.empty() ? report::field_title(field).substr(0, width) : symbol;
}

std::string comparison_line(const std::string& name,
                            const std::string& sph,
                            const std::string& fvm,
                            const std::string& quotient,
                            const std::string& difference = "") {
  std::string line =
      fmt::format("{:<40}{:>14}{:>14}{:>12}{:>18}", name, sph, fvm, quotient, difference);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string rule(size_t width) {
  return std::string(width, '-') + "\n";
}

/// Fields of either run and of the differences, in the order of reports.
std::vector<std::string> compared_fields(const RunSummary& sph,
                                         const RunSummary& fvm,
                                         const std::map<std::string, double>& difference) {
  RunSummary differences;
  for (const auto& [field, value] : difference)
    differences.errors[field].l2 = value;
  return report::fields_of({sph, fvm, differences});
}

using Cells = std::vector<std::string>;

std::string short_title(const std::string& method) {
  return method == "fvm" ? "FVM" : report::method_title(method);
}

std::string columns_line(const std::string& name, const Cells& cells) {
  std::string line = fmt::format("{:<30}", name.substr(0, 29));
  for (const std::string& cell : cells)
    line += fmt::format("{:>14}", cell);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

/// A cell of each run.
template <class Value>
Cells cells_of(const std::vector<RunSummary>& runs, const Value& value) {
  Cells cells;
  for (const RunSummary& run : runs)
    cells.push_back(value(run));
  return cells;
}

/// The probe of this name as the run has it; empty where it has none.
std::string probe_cell(const RunSummary& run,
                       const std::string& name,
                       double io::QuantitySummary::*value) {
  for (const io::QuantitySummary& quantity : run.quantities) {
    if (quantity.name == name) return fmt::format("{:.5g}", quantity.*value);
  }
  return "-";
}

/// How far the columns are from one method; empty where none is known of this field.
std::string distance_line(const std::vector<RunSummary>& runs,
                          const std::vector<report::ColumnDistance>& distances,
                          const std::string& method,
                          const std::string& field) {
  bool has_any = false;
  const Cells cells = cells_of(runs, [&](const RunSummary& run) -> std::string {
    for (const report::ColumnDistance& one : distances) {
      const auto found = one.fields.find(field);
      if (one.column != run.column() || one.method != method || found == one.fields.end()) continue;
      has_any = true;
      return scientific(found->second);
    }
    return "";
  });
  const std::string name = fmt::format("from {}, {}", short_title(method), short_name(field, 18));
  return has_any ? columns_line(name, cells) : "";
}

/// Lines of at most `width` letters, cut behind "=", "+" or "-" where there is one.
Cells lines_of_name(std::string name, size_t width) {
  Cells lines;
  while (name.size() > width) {
    const size_t sign = name.find_last_of("=+-", width - 1);
    const size_t length = sign == name.npos ? width : sign + 1;
    lines.push_back(name.substr(0, length));
    name.erase(0, length);
  }
  lines.push_back(name);
  return lines;
}

/// The methods, and below them the names of the variants.
std::string columns_heading(const std::vector<RunSummary>& runs) {
  std::string text =
      columns_line("", cells_of(runs, [](const auto& run) { return short_title(run.method); }));
  bool has_more = true;
  for (size_t k = 0; has_more; ++k) {
    has_more = false;
    text += columns_line("", cells_of(runs, [&](const RunSummary& run) {
                           const Cells lines = lines_of_name(run.variant, 13);
                           has_more = has_more || lines.size() > k + 1;
                           return k < lines.size() ? lines[k] : "";
                         }));
  }
  return text + rule(30 + 14 * runs.size());
}

std::string columns_block(const std::vector<RunSummary>& runs,
                          const std::vector<report::ColumnDistance>& distances) {
  std::string text = columns_heading(runs);
  const auto line = [&](const std::string& name, const auto& value) {
    text += columns_line(name, cells_of(runs, value));
  };
  line("nodes", [](const RunSummary& run) { return std::to_string(run.nodes); });
  line("pairs", [](const RunSummary& run) { return std::to_string(run.pairs); });
  line("steps", [](const RunSummary& run) { return std::to_string(run.steps); });
  line("time loop [s]", [](const RunSummary& run) { return number(run.loop_seconds); });
  line("per node and stage [ns]",
       [](const RunSummary& run) { return number(run.nanoseconds_per_node_stage); });
  line("per node and crossing [ns]",
       [](const RunSummary& run) { return number(run.nanoseconds_per_node_crossing); });
  for (const std::string& field : report::fields_of(runs)) {
    line("rel. L2 error, " + short_name(field, 14),
         [&](const RunSummary& run) { return scientific(error_of(run, field)); });
  }
  for (const io::QuantitySummary& quantity : runs.front().quantities) {
    const auto probe = [&](const std::string& name, double io::QuantitySummary::*value) {
      line(name, [&](const RunSummary& run) { return probe_cell(run, quantity.name, value); });
    };
    probe(fmt::format("{} [{}], final", quantity.name.substr(0, 18), quantity.unit),
          &io::QuantitySummary::final_value);
    probe("  least", &io::QuantitySummary::least);
    probe("  greatest", &io::QuantitySummary::greatest);
  }
  line("rel. energy residual",
       [](const RunSummary& run) { return scientific(run.energy.relative_residual); });
  RunSummary compared;
  for (const report::ColumnDistance& one : distances) {
    for (const auto& [field, value] : one.fields)
      compared.errors[field] = {};
  }
  for (const char* method : {"sph", "fvm"}) {
    for (const std::string& field : report::fields_of({compared}))
      text += distance_line(runs, distances, method, field);
  }
  return text;
}

std::string convergence_block(const std::vector<RunSummary>& runs,
                              const std::vector<std::string>& fields) {
  std::string head =
      fmt::format("{:>5}{:>12}{:>11}{:>10}", "level", "spacing [m]", "nodes", "loop [s]");
  for (const std::string& field : fields) {
    head += fmt::format("{:>9}{:>6}", short_name(field, 8), "ord.");
  }
  std::string text = head + "\n" + rule(head.size());
  for (size_t i = 0; i < runs.size(); ++i) {
    const RunSummary& run = runs[i];
    text += fmt::format("{:>5}{:>12}{:>11}{:>10}", run.level, number(run.spacing), run.nodes,
                        number(run.loop_seconds));
    for (const std::string& field : fields) {
      const double order = i == 0
                               ? nothing
                               : observed_order(error_of(runs[i - 1], field), error_of(run, field),
                                                runs[i - 1].spacing, run.spacing);
      text +=
          fmt::format("{:>9}{:>6}", scientific(error_of(run, field)), number_text(order, "{:.2f}"));
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string comparison_table(const RunSummary& sph,
                             const RunSummary& fvm,
                             const std::map<std::string, double>& difference,
                             const std::map<std::string, double>& history_difference) {
  std::string text = fmt::format("{}, level {}\n", sph.case_name, sph.level);
  text += comparison_line("", "SPH", "FVM", "SPH/FVM", "SPH-FVM, rel. L2");
  text += rule(98);
  const auto counts = [&](const char* name, std::int64_t a, std::int64_t b) {
    text += comparison_line(name, std::to_string(a), std::to_string(b),
                            ratio(static_cast<double>(a), static_cast<double>(b)));
  };
  const auto values = [&](const char* name, double a, double b) {
    text += comparison_line(name, number(a), number(b), ratio(a, b));
  };
  counts("nodes", sph.nodes, fvm.nodes);
  counts("pairs", sph.pairs, fvm.pairs);
  counts("steps", sph.steps, fvm.steps);
  values("time loop [s]", sph.loop_seconds, fvm.loop_seconds);
  values("per node and stage [ns]", sph.nanoseconds_per_node_stage, fvm.nanoseconds_per_node_stage);
  values("per node and crossing of h [ns]", sph.nanoseconds_per_node_crossing,
         fvm.nanoseconds_per_node_crossing);
  for (const std::string& field : compared_fields(sph, fvm, difference)) {
    const auto found = difference.find(field);
    const double a = error_of(sph, field), b = error_of(fvm, field);
    const std::string symbol = report::field_symbol(field);
    const std::string name =
        fmt::format("rel. L2 error, {}{}", report::field_title(field).substr(0, 22),
                    symbol.empty() ? "" : " " + symbol);
    text += comparison_line(name, scientific(a), scientific(b), ratio(a, b),
                            found == difference.end() ? "-" : scientific(found->second));
  }
  for (size_t k = 0; k < std::min(sph.quantities.size(), fvm.quantities.size()); ++k) {
    const io::QuantitySummary &a = sph.quantities[k], &b = fvm.quantities[k];
    const auto line = [&](const std::string& what, double of_a, double of_b,
                          const std::string& apart = "") {
      text += comparison_line(what, fmt::format("{:.5g}", of_a), fmt::format("{:.5g}", of_b),
                              ratio(of_a, of_b), apart);
    };
    const auto apart = history_difference.find(a.name);
    line(fmt::format("{} [{}], final", a.name, a.unit), a.final_value, b.final_value,
         apart == history_difference.end() ? "" : scientific(apart->second));
    line("  least", a.least, b.least);
    line("  greatest", a.greatest, b.greatest);
    if (a.n_periods > 0 && b.n_periods > 0) line("  period [s]", a.period, b.period);
  }
  text += comparison_line("rel. energy residual", scientific(sph.energy.relative_residual),
                          scientific(fvm.energy.relative_residual), "");
  if (!difference.empty()) {
    text +=
        "errors and SPH-FVM: at the end, relative to the largest norm of the field at any output "
        "time\n";
  }
  if (!history_difference.empty()) {
    text +=
        "SPH-FVM of probes: root mean square over the output times, relative to the largest "
        "magnitude\n";
  }
  return text;
}

std::string columns_table(const std::vector<RunSummary>& runs,
                          const std::vector<report::ColumnDistance>& distances) {
  if (runs.empty()) return "";
  std::string text = fmt::format("{}, level {}: both methods and their variants\n",
                                 runs.front().case_name, runs.front().level);
  for (size_t first = 0; first < runs.size(); first += columns_per_block) {
    const size_t last = std::min(first + columns_per_block, runs.size());
    if (first > 0) text += "\n";
    text += columns_block({runs.begin() + static_cast<std::ptrdiff_t>(first),
                           runs.begin() + static_cast<std::ptrdiff_t>(last)},
                          distances);
  }
  if (!distances.empty()) {
    text +=
        "from SPH, from FVM: at the end, at the settings of the case, relative L2; the verdict is "
        "on "
        "these two\n";
  }
  return text;
}

std::string convergence_table(const std::vector<RunSummary>& levels) {
  const std::vector<std::string> fields = report::fields_of(levels);
  std::string text;
  for (const std::string& column : report::columns_of(levels)) {
    const std::vector<RunSummary> runs = report::runs_of(levels, column);
    text +=
        fmt::format("{}{}, {}: relative L2 errors and observed orders\n", text.empty() ? "" : "\n",
                    report::column_title(column), runs.front().case_name);
    size_t first = 0;
    do {
      const size_t last = std::min(first + fields_per_block, fields.size());
      text += convergence_block(runs, {fields.begin() + static_cast<std::ptrdiff_t>(first),
                                       fields.begin() + static_cast<std::ptrdiff_t>(last)});
      first = last;
    } while (first < fields.size());
  }
  return text;
}

}  // namespace diptych::harness
