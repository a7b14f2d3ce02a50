#pragma once
/// Names, numbers and cells as text: what the tables of several commands are made of.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace diptych::harness {

inline bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// @param format  of fmt; @param otherwise  of what is not finite
inline std::string number_text(double value,
                               const char* format,
                               const std::string& otherwise = "-") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : otherwise;
}

/// "tip displacement [m]"; without the unit where it is "-".
inline std::string with_unit(const std::string& name, const std::string& unit) {
  return unit == "-" ? name : name + " [" + unit + "]";
}

/// A cell of CSV in quotation marks (RFC 4180).
inline std::string quoted(const std::string& text) {
  std::string cell(1, '"');
  for (const char c : text) {
    if (c == '"') cell += c;
    cell += c;
  }
  return cell + '"';
}

}  // namespace diptych::harness
