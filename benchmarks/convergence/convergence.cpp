#include "benchmarks/convergence/convergence.hpp"

#include "benchmarks/terminal/text.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "postprocess/report/orders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace diptych::harness {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Columns that are there to judge the run rather than the body, and momenta, most of which are
/// zero to rounding: looked at on demand.
bool is_on_demand(const std::string& name) {
  static const std::set<std::string> names{
      "time",         "step",         "dt",          "relative energy residual",
      "involution H", "involution J", "least cell J"};
  return names.count(name) > 0 || name.rfind("linear momentum ", 0) == 0 ||
         name.rfind("angular momentum ", 0) == 0;
}

bool is_wanted(const std::string& name, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return !is_on_demand(name);
  return contains(wanted, "all") || contains(wanted, name);
}

std::vector<Quantity> errors_of(const std::vector<io::RunSummary>& levels) {
  std::vector<Quantity> errors;
  for (const std::string& field : report::fields_of(levels)) {
    const std::string title = report::field_title(field);
    Quantity l1{title + " error L1", "-", true, {}, 0}, l2{title + " error L2", "-", true, {}, 0},
        linf{title + " error Linf", "-", true, {}, 0};
    for (const io::RunSummary& run : levels) {
      const auto found = run.errors.find(field);
      const bool has = found != run.errors.end();
      l1.values.push_back(has ? found->second.l1 : nothing);
      l2.values.push_back(has ? found->second.l2 : nothing);
      linf.values.push_back(has ? found->second.linf : nothing);
    }
    errors.insert(errors.end(), {l1, l2, linf});
  }
  return errors;
}

double final_value(const LevelRecord& record, const std::string& name) {
  for (const auto& column : record.history) {
    if (column.name == name && !column.values.empty()) return column.values.back();
  }
  return nothing;
}

/// Largest size of a column over the run; of an energy, of the sum of all.
double scale_of(const LevelRecord& record, const io::HistoryColumn& column) {
  static const std::set<std::string> energies{"kinetic energy", "strain energy",
                                              "viscous dissipation", "numerical dissipation"};
  std::vector<double> sizes(column.values.size());
  for (const auto& other : record.history) {
    const bool counts =
        energies.count(column.name) > 0 ? energies.count(other.name) > 0 : &other == &column;
    if (!counts) continue;
    for (size_t k = 0; k < std::min(sizes.size(), other.values.size()); ++k)
      sizes[k] += std::abs(other.values[k]);
  }
  return sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end());
}

ColumnConvergence convergence_of_column(std::vector<LevelRecord> records,
                                        const std::vector<std::string>& wanted) {
  std::stable_sort(records.begin(), records.end(),
                   [](const auto& a, const auto& b) { return a.summary.level < b.summary.level; });
  ColumnConvergence study;
  study.column = records.front().summary.column();
  study.case_name = records.front().summary.case_name;
  for (const LevelRecord& record : records)
    study.levels.push_back(record.summary);
  study.errors = errors_of(study.levels);
  for (const auto& column : records.front().history) {
    if (!is_wanted(column.name, wanted)) continue;
    Quantity quantity{column.name, column.unit, false, {}, 0};
    for (const LevelRecord& record : records) {
      quantity.values.push_back(final_value(record, column.name));
    }
    for (const auto& own : records.back().history) {
      if (own.name == column.name) quantity.scale = scale_of(records.back(), own);
    }
    const bool is_zero = std::all_of(quantity.values.begin(), quantity.values.end(),
                                     [](double value) { return value == 0; });
    if (is_zero) {
      study.zero.push_back(column.name);
    } else {
      study.scalars.push_back(quantity);
    }
  }
  return study;
}

}  // namespace

void check_columns(const std::vector<io::HistoryColumn>& columns,
                   const std::vector<std::string>& wanted) {
  std::vector<std::string> known{"all"};
  for (const auto& column : columns) {
    if (!contains(known, column.name)) known.push_back(column.name);
  }
  for (const std::string& name : wanted) {
    if (!contains(known, name)) {
      throw base::InputError("--quantity '" + name + "': no column of history.csv has that name" +
                             base::suggestion(name, known));
    }
  }
}

std::vector<ColumnConvergence> convergence_of(const std::vector<LevelRecord>& records,
                                              const std::vector<std::string>& wanted) {
  std::vector<io::RunSummary> summaries;
  std::vector<io::HistoryColumn> columns;
  for (const LevelRecord& record : records) {
    summaries.push_back(record.summary);
    columns.insert(columns.end(), record.history.begin(), record.history.end());
  }
  if (!records.empty()) check_columns(columns, wanted);
  std::vector<ColumnConvergence> studies;
  for (const std::string& column : report::columns_of(summaries)) {
    std::vector<LevelRecord> finished;
    for (const LevelRecord& record : records) {
      if (record.summary.column() == column && record.summary.is_ended())
        finished.push_back(record);
    }
    if (!finished.empty()) studies.push_back(convergence_of_column(finished, wanted));
  }
  return studies;
}

std::optional<report::GridConvergence> estimate(const ColumnConvergence& study,
                                                const Quantity& quantity,
                                                size_t level) {
  if (quantity.is_error) return std::nullopt;
  std::vector<double> spacings;
  for (size_t i = 0; i <= level; ++i)
    spacings.push_back(study.levels[i].spacing);
  const auto begin = quantity.values.begin();
  return report::finest_convergence(spacings,
                                    {begin, begin + static_cast<std::ptrdiff_t>(level) + 1});
}

double error_bar(const ColumnConvergence& study, const Quantity& quantity, size_t level) {
  if (const auto g = estimate(study, quantity, level)) return g->error_bar;
  const bool two = level == 1 && std::isfinite(quantity.values[0] + quantity.values[1]) &&
                   study.levels[1].spacing < study.levels[0].spacing;
  if (!two) return nothing;
  return report::two_grid_error_bar({study.levels[1].spacing, study.levels[0].spacing},
                                    {quantity.values[1], quantity.values[0]});
}

double order_of_error(const ColumnConvergence& study, const Quantity& quantity, size_t level) {
  if (level == 0) return nothing;
  return report::observed_order(quantity.values[level - 1], quantity.values[level],
                                study.levels[level - 1].spacing, study.levels[level].spacing);
}

}  // namespace diptych::harness
