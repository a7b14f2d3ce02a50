#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/bounded_file.hpp"
#include "common/cases/sections/sections.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <string_view>

namespace diptych::cases {

namespace {

namespace fs = std::filesystem;

constexpr size_t most_bytes = size_t{16} << 20;  // 400 000 points

/// The numbers of one line. @return false where it does not hold two finite ones
bool read_pair(std::string_view line, std::array<double, 2>& pair) {
  const size_t comma = line.find(',');
  if (comma == std::string_view::npos) return false;
  const std::array cells{line.substr(0, comma), line.substr(comma + 1)};
  for (size_t i = 0; i < 2; ++i) {
    const size_t first = cells[i].find_first_not_of(" \t");
    const size_t last = cells[i].find_last_not_of(" \t\r");
    if (first == std::string_view::npos) return false;
    const char *begin = cells[i].data() + first, *end = cells[i].data() + last + 1;
    const auto result = std::from_chars(begin, end, pair[i]);
    if (result.ec != std::errc() || result.ptr != end || !std::isfinite(pair[i])) return false;
  }
  return true;
}

std::vector<std::array<double, 2>> points_of_file(const fs::path& path,
                                                  const SectionValues& section) {
  std::error_code ignored;  // a file that cannot be seen is not there
  if (!fs::exists(path, ignored))
    section.fail("file",
                 fmt::format("= '{}' cannot be read: there is no such file", path.string()));
  std::istringstream file(bounded_file(path.string(), most_bytes, "a file of values"));
  std::vector<std::array<double, 2>> points;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (number == 1 || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::array<double, 2> pair{};
    if (!read_pair(line, pair)) {
      throw base::InputError(
          fmt::format("{}:{}: '{}' is not a time (s) and a value; write two "
                      "numbers with a comma between them",
                      path.string(), number, shown(line)));
    }
    points.push_back(pair);
  }
  if (points.empty()) {
    section.fail("file", fmt::format("= '{}' has no values below its first line, which holds names",
                                     path.string()));
  }
  std::sort(points.begin(), points.end());
  return points;
}

ReferenceCase read_reference(const SectionValues& section,
                             const std::vector<ProbeCase>& probes,
                             const fs::path& folder) {
  ReferenceCase reference;
  reference.probe = section.text("probe");
  std::vector<std::string> names;
  for (const ProbeCase& probe : probes)
    names.push_back(probe.name);
  if (std::find(names.begin(), names.end(), reference.probe) == names.end()) {
    section.fail("probe", fmt::format("= '{}' is no probe of this case{}", shown(reference.probe),
                                      base::suggestion(reference.probe, names)));
  }
  reference.source = section.text("source");
  if (section.has("file")) {
    for (const char* name : {"value", "time"})
      section.refuse(name, "has no effect with reference.file; remove one of the two");
    reference.points = points_of_file((folder / section.text("file")).lexically_normal(), section);
  } else {
    reference.points = {{section.number("time"), section.number("value")}};
  }
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
            "the unit of the probe).",
            "\"reference.csv\"", "or reference.value"})
      .key("source", KeyType::text,
           {"-", any, "Where they are from, as the report shall name it.",
            "\"solids4foam/solid-benchmarks\"", "required"});
}

}  // namespace

SectionEntry reference_section() {
  return {{"reference", true,
           "Values of a probe from elsewhere (literature, another code): the report draws them as "
           "points beside the curves of both methods."},
          reference_keys().keys(),
          [](Reading& reading, Case& setup) {
            for (const SectionValues& entry : reading.entries("reference"))
              setup.references.push_back(read_reference(entry, setup.probes, reading.folder));
          }};
}

}  // namespace diptych::cases
