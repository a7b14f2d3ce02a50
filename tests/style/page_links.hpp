#pragma once
/// The pages of the project, and that what they link to is there: files, and sections of pages.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace diptych::tests {

inline std::string text_of_page(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// All pages of the project: the generated ones have notes of people, which quote too.
inline std::vector<std::filesystem::path> pages_of_project(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> pages{root / "README.md", root / "CONTRIBUTING.md",
                                           root / "CHANGELOG.md"};
  for (const char* folder : {"benchmarks", "common", "postprocess", "tests"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
    }
  }
  return pages;
}

/// What a link to a heading is called: "when-a-run-stops" of "When a run stops".
inline std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto code = static_cast<unsigned char>(c);
    if (c == ' ') anchor += '-';
    if (std::isalnum(code) || c == '-' || c == '_' || code > 127)
      anchor += static_cast<char>(std::tolower(code));
  }
  return anchor;
}

inline std::set<std::string> anchors_of(const std::string& page) {
  std::set<std::string> anchors;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    const size_t depth = line.find_first_not_of('#');
    if (depth > 0 && depth < 7 && depth < line.size() && line[depth] == ' ')
      anchors.insert(anchor_of(line.substr(depth + 1)));
  }
  return anchors;
}

/// Links of a page to files that are not there, or to sections that the page they lead to does not
/// have.
inline std::vector<std::string> dead_links(const std::filesystem::path& page) {
  namespace fs = std::filesystem;
  static const std::regex link(R"(\]\(([^)#\s]*)(#([^)\s]*))?\))");
  const std::string text = text_of_page(page);
  std::vector<std::string> dead;
  for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
    const std::string file = (*at)[1], section = (*at)[3];
    if (file.find("://") != std::string::npos || file.starts_with("mailto:")) continue;
    const fs::path target = file.empty() ? page : page.parent_path() / file;
    const bool is_there = fs::exists(target);
    if (!is_there || (!section.empty() && target.extension() == ".md" &&
                      !anchors_of(text_of_page(target)).contains(section)))
      dead.push_back(page.filename().string() + ": " + at->str());
  }
  return dead;
}

}  // namespace diptych::tests
