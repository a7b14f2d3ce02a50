#include "benchmarks/harness/case_list.hpp"

#include "benchmarks/harness/data_folder.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/run/case_reader.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace diptych::harness {

namespace fs = std::filesystem;

std::string cases_folder() {
  const char* folder = std::getenv("DIPTYCH_CASES");
  return folder != nullptr ? folder : data_folder("cases");
}

namespace {

std::vector<std::string> names_of_cases() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(cases_folder(), error)) {
    if (fs::exists(entry.path() / "case.toml")) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> shipped_cases() {
  std::vector<std::pair<std::string, std::string>> cases;
  for (const std::string& name : names_of_cases()) {
    const fs::path file = fs::path(cases_folder()) / name / "case.toml";
    cases.emplace_back(name, run::read_case(file.string()).title);
  }
  return cases;
}

std::string find_case(const std::string& name) {
  std::error_code error;
  if (fs::is_regular_file(name, error)) return name;
  if (fs::is_regular_file(fs::path(name) / "case.toml", error)) {
    return (fs::path(name) / "case.toml").string();
  }
  const fs::path shipped = fs::path(cases_folder()) / name / "case.toml";
  const bool is_name = name.find('/') == std::string::npos && !name.empty();
  if (is_name && fs::is_regular_file(shipped, error)) return shipped.string();
  throw base::InputError("no case file '" + name + "', and no shipped case of that name" +
                         base::suggestion(name, names_of_cases()) + " ('diptych list' shows them)");
}

}  // namespace diptych::harness
