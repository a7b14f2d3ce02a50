/// Which cases a regression takes and where their baselines are.

#include "benchmarks/regression/verb.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/io/run_record.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

bool is_blank(const std::string& text) {
  return text.find_first_not_of(" \t\n") == std::string::npos;
}

void check_bless(const RegressRequest& request) {
  if (!request.cases.empty())
    throw base::InputError("--bless names the case itself: give no other case");
  if (is_blank(request.why))
    throw base::InputError("--bless needs --why \"...\": the reason is kept with the baseline");
  if (!request.junit.empty() || !request.json.empty())
    throw base::InputError("--junit and --json go with a check, not with --bless");
  const bool has_size = !request.set.empty() || request.levels != 0;
  if (request.bless == "all" && has_size) {
    throw base::InputError(
        "--set and --levels are the size of one case: give them with --bless CASE");
  }
  if (request.levels < 0 || request.levels > 2)
    throw base::InputError(fmt::format("--levels {} must be 1 or 2", request.levels));
  if (request.levels == 1 && is_blank(request.one_level_because)) {
    throw base::InputError(
        "--levels 1 needs --one-level-because \"...\": without level 1 the agreement of the "
        "methods is not judged, and the reason is kept with the baseline");
  }
  if (request.levels != 1 && !request.one_level_because.empty())
    throw base::InputError("--one-level-because goes with --levels 1");
}

void check_request(const RegressRequest& request) {
  if (!request.bless.empty()) {
    check_bless(request);
  } else if (!request.why.empty()) {
    throw base::InputError("--why goes with --bless CASE");
  } else if (!request.set.empty() || request.levels != 0 || !request.one_level_because.empty()) {
    throw base::InputError(
        "--set, --levels and --one-level-because go with --bless CASE: a check runs the size that "
        "was recorded");
  }
  const bool same = !request.junit.empty() && request.junit == request.json;
  if (same) throw base::InputError("--junit and --json name the same file");
}

/// The words of the command line that are cases; empty: all.
std::vector<std::string> words_of(const RegressRequest& request) {
  if (request.bless.empty()) return request.cases;
  return request.bless == "all" ? std::vector<std::string>{}
                                : std::vector<std::string>{request.bless};
}

/// Cases of somewhere else do not meet the baselines of the shipped ones by accident of a name.
void check_baselines(const RegressRequest& request, const std::vector<ListedCase>& cases) {
  const char* set = std::getenv("DIPTYCH_BASELINES");
  if (!request.baselines_folder.empty() || (set != nullptr && *set != '\0')) return;
  for (const ListedCase& entry : cases) {
    std::error_code error;
    const fs::path folder = fs::absolute(entry.file).lexically_normal().parent_path();
    if (fs::equivalent(folder.parent_path(), cases_folder(), error)) continue;
    throw base::InputError(fmt::format(
        "{} is not of the shipped cases: give --baselines DIR, the folder of its baseline {}.json",
        entry.file, entry.name));
  }
}

}  // namespace

std::vector<ListedCase> wanted_cases(const RegressRequest& request) {
  check_request(request);
  std::vector<ListedCase> cases;
  std::set<std::string> names;
  for (const std::string& word : words_of(request)) {
    const std::string file = find_case(word, request.cases_folder);
    cases.push_back({cases::case_name(file), file});
    if (!names.insert(cases.back().name).second) {
      throw base::InputError(fmt::format(
          "two cases are named '{}', and baselines go by name: check one of them at a time",
          cases.back().name));
    }
  }
  if (cases.empty()) cases = listed_cases(request.cases_folder);
  check_baselines(request, cases);
  return cases;
}

std::string baseline_path(const RegressRequest& request, const std::string& case_name) {
  return (fs::path(baselines_folder(request.baselines_folder)) / (case_name + ".json")).string();
}

RegressBaseline read_baseline(const std::string& path, const std::string& case_name) {
  RegressBaseline baseline = baseline_from_json(io::read_file(path), path);
  if (baseline.case_name != case_name)
    throw base::InputError(fmt::format("{}: is of case '{}'", path, baseline.case_name));
  return baseline;
}

std::vector<RegressedCase> orphans(const RegressRequest& request) {
  std::set<std::string> names;
  for (const ListedCase& entry : listed_cases(request.cases_folder))
    names.insert(entry.name);
  std::vector<RegressedCase> gone;
  std::error_code error;
  for (const auto& entry :
       fs::directory_iterator(baselines_folder(request.baselines_folder), error)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".json" || names.count(name) > 0) continue;
    const std::string note = fmt::format(
        "no case of this name in {}: remove the file, or bring "
        "the case back",
        cases_folder(request.cases_folder));
    const RegressCheck check = failure("record", entry.path().filename().string(), note);
    gone.push_back({name, "", baseline_path(request, name), 0, {{name, "-", {check}}}});
  }
  std::sort(gone.begin(), gone.end(),
            [](const RegressedCase& a, const RegressedCase& b) { return a.name < b.name; });
  return gone;
}

}  // namespace diptych::harness
