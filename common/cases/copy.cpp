#include "common/cases/copy.hpp"

#include "common/base/error.hpp"
#include "common/cases/sections/sections.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace diptych::cases {

namespace {

namespace fs = std::filesystem;

/// Stands between the text and what is put below it.
constexpr const char* boundary =
    "\n# ---- added by diptych: this is a copy of the case file, with what the command line had\n";

/// A basic string of TOML.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

SectionKeys<CaseRecord> record_keys() {
  return SectionKeys<CaseRecord>("record")
      .key("file", &CaseRecord::file,
           as(KeyType::path, {"-", any,
                              "The case file that this is a copy of: it names the case, and "
                              "relative paths start there.",
                              "\"/home/me/cube/case.toml\"", "in a copy"}))
      .key("overrides", &CaseRecord::overrides,
           as(KeyType::texts,
              {"-", any, "What the command line had set (--set), read before any --set of now.",
               "[\"time.end=0.1\", \"sph.kappa=0.75\"]"}));
}

}  // namespace

std::string case_copy(const Case& setup) {
  std::string text = setup.text + boundary;
  text += "[record]\nfile = " + quoted(setup.file) + "\noverrides = [";
  for (const std::string& assignment : setup.overrides)
    text += "\n  " + quoted(assignment) + ",";
  return text + (setup.overrides.empty() ? "]\n" : "\n]\n");
}

std::string original_text(const std::string& text) {
  return text.substr(0, text.rfind(boundary));
}

bool is_case_copy(const std::string& text) {
  return text.find(boundary) != std::string::npos;
}

CaseRecord record_of(const Value& document, const std::string& path) {
  const Member* member = document.find("record");
  if (member == nullptr) return {};
  const Menus none;
  const Reading reading{.document = document, .menus = none};
  CaseRecord record = record_keys().read(reading.section("record"));
  record.file = (fs::path(path).parent_path() / record.file).lexically_normal().string();
  return record;
}

SectionEntry record_section() {
  return {{"record", false,
           "Of the copy of a case file that a run leaves among its results; not for other files."},
          record_keys().keys(),
          [](Reading&, Case&) {}};  // record_of() has read it: it says what to read
}

std::vector<std::string> merged_overrides(const std::vector<std::string>& first,
                                          const std::vector<std::string>& second) {
  std::vector<std::string> merged;
  for (const std::string& assignment : first) {
    const std::string key = key_of(assignment);
    const bool is_replaced = std::any_of(second.begin(), second.end(),
                                         [&](const auto& later) { return key_of(later) == key; });
    if (!is_replaced) merged.push_back(assignment);
  }
  merged.insert(merged.end(), second.begin(), second.end());
  return merged;
}

}  // namespace diptych::cases
