#include "benchmarks/run/case_list.hpp"

#include "benchmarks/run/data_folder.hpp"
#include "benchmarks/run/menus.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>

namespace diptych::harness {

namespace fs = std::filesystem;

namespace {

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// Whether the folder is the program's own choice, which no user has typed.
bool is_built_in(const std::string& asked) {
  const char* set = std::getenv("DIPTYCH_CASES");
  return asked.empty() && (set == nullptr || *set == '\0');
}

/// Why a folder has no case, and what to do.
std::string no_case_in(const std::string& folder, const std::string& asked) {
  std::error_code error;
  if (is_file(fs::path(folder) / "case.toml")) {
    return fmt::format(
        "'{0}' is a case, not a folder of cases: give '{0}' itself as the case, or the folder "
        "around it as --cases",
        folder);
  }
  const bool exists = fs::is_directory(folder, error);
  if (is_built_in(asked)) {
    return fmt::format(
        "the shipped cases are not in '{0}' ({1}); install the program again, or say where cases "
        "are with --cases DIR or DIPTYCH_CASES=DIR, which holds DIR/NAME/case.toml",
        folder, exists ? "no folder NAME/case.toml is there" : "no such folder");
  }
  return fmt::format("no case in '{0}'{1}: expected {0}/NAME/case.toml, a folder for each case",
                     folder, exists ? "" : ", which is no folder");
}

/// A path or a name: what has no '/' and is no .toml file may be a name.
bool may_be_name(const std::string& word) {
  return !word.empty() && word != "." && word != ".." && word.find('/') == std::string::npos &&
         fs::path(word).extension() != ".toml";
}

std::vector<std::string> names_of(const std::vector<ListedCase>& cases) {
  std::vector<std::string> names;
  for (const ListedCase& entry : cases)
    names.push_back(entry.name);
  return names;
}

/// The case file that a path means; empty where there is none.
std::string file_of_path(const std::string& word) {
  if (is_file(word)) return word;
  const fs::path inside = fs::path(word) / "case.toml";
  return is_file(inside) ? inside.string() : "";
}

/// What is said of a word that is no case.
[[noreturn]] void refuse(const std::string& word, const std::string& asked) {
  std::error_code error;
  const bool is_name = may_be_name(word);
  if (fs::is_directory(word, error) && !(is_name && !asked.empty())) {
    throw base::InputError(fmt::format(
        "'{0}' has no case.toml; where it is a folder of cases, give it as --cases {0}", word));
  }
  if (!is_name) {
    throw base::InputError(
        fmt::format("no case file '{}'; give a .toml file, a folder with a case.toml, or a name "
                    "that 'diptych list' shows",
                    word));
  }
  const std::vector<std::string> names = names_of(listed_cases(asked));
  const std::string nearest = base::suggestion(word, names);
  if (asked.empty()) {
    throw base::InputError("no case file '" + word + "', and no shipped case of that name" +
                           nearest + " ('diptych list' shows them)");
  }
  throw base::InputError(fmt::format("no case '{}' in {}{} ('diptych list --cases {}' shows them)",
                                     word, asked, nearest, asked));
}

}  // namespace

std::string cases_folder(const std::string& asked) {
  if (!asked.empty()) return asked;
  return is_built_in(asked) ? data_folder("cases") : std::getenv("DIPTYCH_CASES");
}

std::vector<ListedCase> listed_cases(const std::string& asked) {
  const std::string folder = cases_folder(asked);
  std::vector<ListedCase> cases;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path file = entry.path() / "case.toml";
    if (is_file(file)) cases.push_back({entry.path().filename().string(), file.string()});
  }
  if (cases.empty()) throw base::InputError(no_case_in(folder, asked));
  std::sort(cases.begin(), cases.end(),
            [](const ListedCase& a, const ListedCase& b) { return a.name < b.name; });
  return cases;
}

std::string find_case(const std::string& word, const std::string& asked) {
  if (asked.empty() || !may_be_name(word)) {
    if (std::string file = file_of_path(word); !file.empty()) return file;
  }
  if (may_be_name(word)) {
    const fs::path file = fs::path(cases_folder(asked)) / word / "case.toml";
    if (is_file(file)) return file.string();
  }
  refuse(word, asked);
}

}  // namespace diptych::harness
