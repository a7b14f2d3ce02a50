#include "postprocess/report/orders.hpp"

#include "common/time/integrator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace diptych::report {
namespace {

/// Known names in their order, then the rest by name.
template <size_t n>
std::vector<std::string> ordered(const std::set<std::string>& names,
                                 const std::array<const char*, n>& first) {
  std::vector<std::string> result;
  for (const char* name : first) {
    if (names.count(name) > 0) result.emplace_back(name);
  }
  for (const std::string& name : names) {
    if (std::find(result.begin(), result.end(), name) == result.end()) result.push_back(name);
  }
  return result;
}

bool usable(double value) {
  return std::isfinite(value) && value > 0;
}

}  // namespace

double observed_order(double coarse_error,
                      double fine_error,
                      double coarse_spacing,
                      double fine_spacing) {
  if (!usable(coarse_error) || !usable(fine_error) || !usable(coarse_spacing) ||
      !usable(fine_spacing) || coarse_spacing == fine_spacing) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::log(coarse_error / fine_error) / std::log(coarse_spacing / fine_spacing);
}

FormalOrder formal_order(const io::RunSummary& run) {
  const auto has = [&](const char* order) {
    return run.graph_operators.find(order) != std::string::npos;
  };
  const double in_space = has("order 4") && !has("order 2") ? 3 : 2;  // the lowest of all lines
  const double in_time = time::integrator_menu().at(run.integrator).order;
  return {std::min(in_space, in_time), in_space};
}

std::vector<std::string> methods_of(const std::vector<io::RunSummary>& runs) {
  std::set<std::string> names;
  for (const io::RunSummary& run : runs) {
    if (run.variant.empty()) names.insert(run.method);
  }
  return ordered(names, std::array{"sph", "fvm"});
}

std::vector<std::string> columns_of(const std::vector<io::RunSummary>& runs) {
  std::vector<std::string> columns = methods_of(runs);
  for (const io::RunSummary& run : runs) {
    if (std::find(columns.begin(), columns.end(), run.column()) == columns.end())
      columns.push_back(run.column());
  }
  return columns;
}

std::string method_of_column(const std::string& column) {
  return column.substr(0, column.find('-'));
}

std::string variant_of_column(const std::string& column) {
  const size_t dash = column.find('-');
  return dash == column.npos ? "" : column.substr(dash + 1);
}

std::vector<io::RunSummary> runs_of(const std::vector<io::RunSummary>& runs,
                                    std::string_view column) {
  std::vector<io::RunSummary> result;
  for (const io::RunSummary& run : runs) {
    if (run.column() == column) result.push_back(run);
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const io::RunSummary& a, const io::RunSummary& b) {
                     return a.level != b.level ? a.level < b.level : a.spacing > b.spacing;
                   });
  return result;
}

std::vector<std::string> fields_of(const std::vector<io::RunSummary>& runs) {
  std::set<std::string> names;
  for (const io::RunSummary& run : runs) {
    for (const auto& [field, norms] : run.errors)
      names.insert(field);
  }
  return ordered(names, std::array{"velocity", "displacement", "deformation_gradient", "stress",
                                   "cofactor", "jacobian", "viscous_C", "viscous_G"});
}

double error_of(const io::RunSummary& run, const std::string& field) {
  const auto found = run.errors.find(field);
  return found == run.errors.end() ? std::numeric_limits<double>::quiet_NaN() : found->second.l2;
}

std::string method_title(const std::string& method) {
  if (method == "sph") return "SPH";
  if (method == "fvm") return "Finite volume";
  return method;
}

std::string column_title(const std::string& column) {
  const std::string variant = variant_of_column(column);
  return method_title(method_of_column(column)) + (variant.empty() ? "" : " " + variant);
}

std::string field_symbol(const std::string& field) {
  if (field == "velocity") return "v";
  if (field == "displacement") return "u";
  if (field == "deformation_gradient") return "F";
  if (field == "stress") return "P";
  if (field == "cofactor") return "H";
  if (field == "jacobian") return "J";
  if (field == "viscous_C") return "A";
  if (field == "viscous_G") return "S";
  return "";
}

std::string field_title(const std::string& field) {
  std::string title = field;
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

}  // namespace diptych::report
