#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/bounded_file.hpp"
#include "common/cases/sections/sections.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <sstream>
#include <string_view>

namespace diptych::cases {

namespace {

namespace fs = std::filesystem;

constexpr size_t most_bytes = size_t{16} << 20;  // 400 000 points

/// Without the blanks around them; in quotes a cell may hold commas, and quotes twice (RFC 4180).
std::vector<std::string> cells_of(std::string_view line) {
  constexpr const char* blanks = " \t\r";
  std::vector<std::string> cells;
  for (bool is_last = false; !is_last;) {
    std::string cell;
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    if (line.starts_with('"')) {
      for (line.remove_prefix(1); !line.empty(); line.remove_prefix(1)) {
        if (line.front() == '"') {
          line.remove_prefix(1);
          if (!line.starts_with('"')) break;
        }
        cell += line.front();
      }
    }
    const size_t comma = line.find(',');
    cell += line.substr(0, comma);
    cell.erase(cell.find_last_not_of(blanks) + 1);
    cells.push_back(std::move(cell));
    is_last = comma == std::string_view::npos;
    if (!is_last) line.remove_prefix(comma + 1);
  }
  return cells;
}

/// @return false where the cell holds no finite number
bool read_number(std::string_view cell, double& number) {
  const auto result = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return result.ec == std::errc() && result.ptr == cell.data() + cell.size() &&
         std::isfinite(number);
}

/// Which columns of a file are read: the first, times, and the one of the values.
struct FileColumns {
  size_t n = 2, value = 1;
};

/// What stands in brackets at the end of a name, "mm" of "x [mm]"; nothing where none do.
std::optional<std::string> unit_of(const std::string& name, char open_bracket, char close_bracket) {
  const size_t open = name.rfind(open_bracket);
  if (open == std::string::npos || name.back() != close_bracket) return std::nullopt;
  return name.substr(open + 1, name.size() - open - 2);
}

/// @throws base::InputError where the first line holds no names, or other units than are asked
void check_names(const std::string& heading,
                 const FileColumns& columns,
                 const std::string& unit,
                 const std::string& path) {
  const std::vector<std::string> names = cells_of(heading);
  double number = 0;
  if (read_number(names.front(), number)) {
    throw base::InputError(
        fmt::format("{}:1: '{}' is a line of numbers; write a line of names above it, as in \"time "
                    "[s],value [{}]\"",
                    path, shown(heading), unit));
  }
  const auto check = [&](size_t column, const std::string& asked) {
    auto found = column < names.size() ? unit_of(names[column], '[', ']') : std::nullopt;
    if (column == 0 && !found) found = unit_of(names[0], '(', ')');
    if (!found || *found == asked || (asked == "-" && (found->empty() || *found == "1"))) return;
    throw base::InputError(
        fmt::format("{}:1: '{}' is in {}, asked is {}; write the values in that "
                    "unit",
                    path, shown(names[column]), shown(*found), asked));
  };
  check(0, "s");
  check(columns.value, unit);
}

FileColumns columns_of(const std::string& heading, const SectionValues& section) {
  if (!section.has("column")) return {};
  const std::string wanted = section.text("column");
  const std::vector<std::string> names = cells_of(heading);
  const auto found = std::find(names.begin() + 1, names.end(), wanted);
  if (found == names.end()) {
    section.fail("column", fmt::format("= '{}' is no column of the file behind its first{}",
                                       shown(wanted), base::suggestion(wanted, names)));
  }
  return {names.size(), static_cast<size_t>(found - names.begin())};
}

/// The time and the value of one line. @return false where it does not hold them
bool read_pair(std::string_view line, const FileColumns& columns, std::array<double, 2>& pair) {
  const std::vector<std::string> cells = cells_of(line);
  return cells.size() == columns.n && read_number(cells[0], pair[0]) &&
         read_number(cells[columns.value], pair[1]);
}

std::vector<std::array<double, 2>> points_of_file(const fs::path& path,
                                                  const std::string& unit,
                                                  const SectionValues& section) {
  std::error_code ignored;  // a file that cannot be seen is not there
  if (!fs::exists(path, ignored))
    section.fail("file",
                 fmt::format("= '{}' cannot be read: there is no such file", path.string()));
  std::istringstream file(bounded_file(path.string(), most_bytes, "a file of values"));
  std::vector<std::array<double, 2>> points;
  std::string line;
  FileColumns columns;
  for (int number = 1; std::getline(file, line); ++number) {
    if (number == 1) {
      columns = columns_of(line, section);
      check_names(line, columns, unit, path.string());
    }
    if (number == 1 || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::array<double, 2> pair{};
    if (!read_pair(line, columns, pair)) {
      throw base::InputError(
          section.has("column")
              ? fmt::format("{}:{}: '{}' is not a line of {} cells with a time (s) in the first "
                            "and a value in '{}'",
                            path.string(), number, shown(line), columns.n,
                            shown(section.text("column")))
              : fmt::format("{}:{}: '{}' is not a time (s) and a value; write two "
                            "numbers with a comma between them",
                            path.string(), number, shown(line)));
    }
    if (!points.empty() && !(pair[0] > points.back()[0])) {
      throw base::InputError(
          fmt::format("{}:{}: the time {:g} s is not after that of the value before it, {:g} s; "
                      "sort the lines by time, one for each",
                      path.string(), number, pair[0], points.back()[0]));
    }
    points.push_back(pair);
  }
  if (points.empty()) {
    section.fail("file", fmt::format("= '{}' has no values below its first line, which holds names",
                                     path.string()));
  }
  return points;
}

/// In the unit of the probe; nothing where none is stated.
std::optional<double> uncertainty_of(const SectionValues& section, const ReferenceCase& reference) {
  if (section.has("uncertainty")) {
    section.refuse("relative_uncertainty",
                   "has no effect with reference.uncertainty; remove one of the two");
    return section.number("uncertainty");
  }
  if (!section.has("relative_uncertainty")) return std::nullopt;
  double greatest = 0;
  for (const auto& point : reference.points)
    greatest = std::max(greatest, std::abs(point[1]));
  if (greatest == 0)
    section.fail("relative_uncertainty", "is a share of values that are all 0; use uncertainty");
  return section.number("relative_uncertainty") * greatest;
}

ReferenceCase read_reference(const SectionValues& section,
                             const std::vector<ProbeCase>& probes,
                             const fs::path& folder) {
  ReferenceCase reference;
  reference.probe = section.text("probe");
  std::vector<std::string> names;
  std::string unit;
  for (const ProbeCase& probe : probes) {
    names.push_back(probe.name);
    if (probe.name == reference.probe) unit = probe.unit;
  }
  if (std::find(names.begin(), names.end(), reference.probe) == names.end()) {
    section.fail("probe", fmt::format("= '{}' is no probe of this case{}", shown(reference.probe),
                                      base::suggestion(reference.probe, names)));
  }
  reference.source = section.text("source");
  if (section.has("file")) {
    for (const char* name : {"value", "time"})
      section.refuse(name, "has no effect with reference.file; remove one of the two");
    reference.points =
        points_of_file((folder / section.text("file")).lexically_normal(), unit, section);
  } else {
    section.refuse("column", "has no effect without reference.file; remove it");
    reference.points = {{section.number("time"), section.number("value")}};
  }
  reference.uncertainty = uncertainty_of(section, reference);
  return reference;
}

SectionKeys<ReferenceCase> reference_keys() {
  return SectionKeys<ReferenceCase>("reference")
      .key("probe", KeyType::text,
           {"-", any, "Name of the probe that they belong to.", "\"tip deflection\"", "required"})
      .key("value", KeyType::number,
           {"that of the probe", any, "One value.", "14.735", "or reference.file"})
      .key("time", KeyType::number, {"s", at_least(0), "Its time.", "0.08", "with value"})
      .key("file", KeyType::path,
           {"-", any,
            "CSV file beside the case file: a line of names, then lines of time (s) and value (in "
            "the unit of the probe), times increasing.",
            "\"reference.csv\"", "or reference.value"})
      .key("column", KeyType::text,
           optional({"-", any, "Of a file with further columns: the name above the values.",
                     "\"x0 [m]\"", "with reference.file, optional"}))
      .key("uncertainty", KeyType::number,
           optional(
               {"that of the probe", above(0),
                "How far the values may be from the truth, all of them: what runs are asked to be "
                "within.",
                "0.005", "optional"}))
      .key("relative_uncertainty", KeyType::number,
           optional({"-", above(0), "The same as a share of the largest of their sizes.", "0.02",
                     "optional"}))
      .key("source", KeyType::text,
           {"-", any, "Where they are from, as the report shall name it.",
            "\"solids4foam/solid-benchmarks\"", "required"});
}

}  // namespace

SectionEntry reference_section() {
  return {
      {"reference", true,
       "Values of a probe from elsewhere (literature, another code). Every run says how far it is "
       "from them at their times, between its output times along straight lines (or they "
       "along theirs, where they have more times than the run), and whether it is within the "
       "uncertainty that they state; the report draws them beside the curves. A run whose "
       "material, parameters, initial state, boundary, load or body was changed by an override "
       "is not held against them."},
      reference_keys().keys(),
      [](Reading& reading, Case& setup) {
        for (const SectionValues& entry : reading.entries("reference"))
          setup.references.push_back(read_reference(entry, setup.probes, reading.folder));
      }};
}

}  // namespace diptych::cases
