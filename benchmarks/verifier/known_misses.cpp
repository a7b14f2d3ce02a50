#include "benchmarks/verifier/known_misses.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace diptych::harness {

namespace {

/// Without blanks at either end and the comment.
std::string content_of(const std::string& line) {
  const std::string text = line.substr(0, line.find('#'));
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string table_of(const std::string& miss) {
  return miss.substr(0, miss.find(" | "));
}

}  // namespace

std::set<std::string> misses_of(const std::vector<VerificationResult>& results) {
  std::set<std::string> misses;
  for (const VerificationResult& result : results) {
    for (const VerificationVerdict& v : result.verdicts) {
      if (v.met) continue;
      misses.insert(fmt::format("{} | {} | {} | {} | {}", result.table.name, v.run, v.column,
                                v.asked, v.method));
    }
  }
  return misses;
}

std::set<std::string> read_known_misses(const std::string& path) {
  std::istringstream file(io::read_file(path));
  std::set<std::string> known;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string content = content_of(line);
    if (content.empty()) continue;
    const auto n_bars = std::count(content.begin(), content.end(), '|');
    if (n_bars != 4) {
      throw base::InputError(fmt::format(
          "{}:{}: write TABLE | RUN | COLUMN | ASKED | METHOD; the line has {} of five parts", path,
          number, n_bars + 1));
    }
    if (!known.insert(content).second)
      throw base::InputError(fmt::format("{}:{}: stands twice", path, number));
  }
  return known;
}

std::vector<std::string> differences_from_known(const std::vector<VerificationResult>& results,
                                                const std::set<std::string>& known) {
  std::set<std::string> made;
  for (const VerificationResult& result : results)
    made.insert(result.table.name);
  const std::set<std::string> misses = misses_of(results);
  std::vector<std::string> differences;
  for (const std::string& miss : misses) {
    if (known.count(miss) == 0) differences.push_back("not met, and not known: " + miss);
  }
  for (const std::string& line : known) {
    if (made.count(table_of(line)) > 0 && misses.count(line) == 0)
      differences.push_back("met now, take it from the list: " + line);
  }
  return differences;
}

}  // namespace diptych::harness
