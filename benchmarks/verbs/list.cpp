/// diptych list: the cases of a folder with their titles.

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/base/error.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <memory>

namespace diptych::verbs {

namespace {

struct ListArguments {
  std::vector<std::string> words;
  std::string cases_folder;
};

std::vector<harness::ListedCase> wanted(const ListArguments& arguments) {
  if (arguments.words.empty()) return harness::listed_cases(arguments.cases_folder);
  std::vector<harness::ListedCase> cases;
  for (const std::string& word : arguments.words) {
    const std::string file = harness::find_case(word, arguments.cases_folder);
    cases.push_back({cases::case_name(file), file});
  }
  return cases;
}

/// A case that cannot be read does not hide the others.
int list(const ListArguments& arguments) {
  const std::vector<harness::ListedCase> cases = wanted(arguments);
  size_t n_broken = 0;
  for (const harness::ListedCase& entry : cases) {
    try {
      print(fmt::format("{:<32} {}\n", entry.name, harness::read_case(entry.file).title));
    } catch (const base::InputError& error) {
      std::fputs(fmt::format("diptych: {}\n", error.what()).c_str(), stderr);
      ++n_broken;
    }
  }
  if (n_broken == 0) return 0;
  throw base::InputError(
      fmt::format("{} of {} cases cannot be read; see above", n_broken, cases.size()));
}

}  // namespace

Action declare_list(CommandLine& line) {
  const auto arguments = std::make_shared<ListArguments>();
  line.words("case", arguments->words, "names or paths of cases (default: all of the folder)");
  line.option("--cases", arguments->cases_folder, cases_help);
  return [arguments] { return list(*arguments); };
}

}  // namespace diptych::verbs
