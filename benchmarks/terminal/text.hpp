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

/// In lines of at most `width` characters, broken at spaces; those after the first begin with as
/// many spaces as `indent` says. A word that is longer stands alone.
inline std::string folded(const std::string& text, size_t width, size_t indent) {
  std::string all, line = text;
  while (line.size() > width) {
    const size_t first = line.find_first_not_of(' ');
    size_t at = line.rfind(' ', width);
    if (at == std::string::npos || at <= std::max(first, indent)) at = line.find(' ', width);
    if (at == std::string::npos) break;
    all += line.substr(0, at) + "\n";
    line = std::string(indent, ' ') + line.substr(at + 1);
  }
  return all + line;
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
