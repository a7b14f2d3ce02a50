#pragma once
/// The rules of the source tree that a machine can check: which room may include which, which room
/// a third-party library is included in, the shape of a file, and what it cites. Functions of a
/// file's path and text alone, so that the checks can themselves be checked. Each check answers a
/// list of complaints, "path:line: what is wrong", empty where all is well.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych::tests {

using Complaints = std::vector<std::string>;

struct SourceFile {
  std::string path;  ///< from the top level, with forward slashes
  std::string text;
};

/// The rooms, and beside each what it may include besides itself.
inline const std::map<std::string, std::set<std::string>>& permitted_rooms() {
  static const auto rooms = [] {
    const std::set<std::string> algebra = {"common/base", "common/algebra"};
    const auto with = [](std::set<std::string> set, std::initializer_list<const char*> more) {
      set.insert(more.begin(), more.end());
      return set;
    };
    const auto scheme = with(algebra, {"common/parallel", "common/physics"});
    const auto above = with(scheme, {"common/scheme"});  // what stands on the scheme
    const auto exact = with(above, {"common/functions"});
    const auto cases = with(exact, {"common/exact", "common/time", "meshes"});
    const auto run = with(cases, {"common/cases", "common/io"});
    const auto graph = with(above, {"common/closure", "meshes"});
    const auto all = with(run, {"common/run", "sph", "fvm", "postprocess"});
    const auto terminal = with(all, {"benchmarks/terminal"});
    const auto runs = with(terminal, {"common/closure", "benchmarks/run"});
    const auto campaign = with(runs, {"benchmarks/campaign"});
    const auto studies =
        with(campaign, {"benchmarks/convergence", "benchmarks/cost", "benchmarks/probes"});
    const auto verbs =
        with(studies, {"benchmarks/study", "benchmarks/verifier", "benchmarks/regression",
                       "benchmarks/material", "benchmarks/verbs"});
    return std::map<std::string, std::set<std::string>>{
        {"common/base", {}},
        {"common/algebra", {"common/base"}},
        {"common/parallel", algebra},
        {"common/mpi", with(algebra, {"common/parallel"})},
        {"common/physics", algebra},
        {"common/io", algebra},
        {"common/scheme", with(scheme, {"meshes"})},
        {"common/closure", above},
        {"common/time", above},
        {"common/functions", with(algebra, {"common/parallel"})},
        {"common/exact", exact},
        {"common/cases", cases},
        {"common/run", run},
        {"meshes", with(algebra, {"common/parallel"})},
        {"sph", graph},
        {"fvm", graph},
        {"postprocess", with(algebra, {"common/io", "common/time"})},
        {"benchmarks/probes", scheme},
        {"benchmarks/terminal", all},
        {"benchmarks/run", with(terminal, {"common/closure"})},
        {"benchmarks/campaign", runs},
        {"benchmarks/convergence", runs},
        {"benchmarks/material", runs},
        {"benchmarks/cost", with(runs, {"benchmarks/probes"})},
        {"benchmarks/verifier", with(campaign, {"benchmarks/probes"})},
        {"benchmarks/regression", with(campaign, {"benchmarks/convergence"})},
        {"benchmarks/study", studies},
        {"benchmarks/micro", studies},
        {"benchmarks/verbs", verbs},
        {"benchmarks", verbs},
        {"tests", with(verbs, {"common/closure", "benchmarks", "benchmarks/micro"})}};
  }();
  return rooms;
}

/// "common/physics" of "common/physics/materials/x.hpp", "meshes" of "meshes/x.cpp"; empty where
/// the path lies in no room.
inline std::string room_of(const std::string& path) {
  std::string longest;  // "benchmarks/run" rather than "benchmarks"
  for (const auto& [room, permitted] : permitted_rooms()) {
    if (path.rfind(room + "/", 0) == 0 && room.size() > longest.size()) longest = room;
  }
  return longest;
}

inline bool is_code(const std::string& path) {
  const auto extension = std::filesystem::path(path).extension();
  return extension == ".hpp" || extension == ".cpp";
}

/// Sources, build files, case files and meshes of the rooms, sorted by path.
/// @throws std::runtime_error where there is nothing to read: a wrong path would pass every check
inline std::vector<SourceFile> read_source_tree(const std::string& top_level) {
  namespace fs = std::filesystem;
  static const std::set<std::string> texts = {".toml", ".geo", ".cmake", ".in",
                                              ".js",   ".css", ".def"};
  std::vector<SourceFile> files;
  for (const char* folder :
       {"common", "sph", "fvm", "meshes", "benchmarks", "postprocess", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(top_level) / folder)) {
      const std::string path = fs::relative(entry.path(), top_level).generic_string();
      const bool wanted = is_code(path) || texts.count(entry.path().extension().string()) > 0 ||
                          entry.path().filename() == "CMakeLists.txt";
      if (!entry.is_regular_file() || !wanted) continue;
      if (path.starts_with("tests/additions/files/")) continue;  // parts of a tree that is not here
      std::ifstream stream(entry.path());
      if (!stream) throw std::runtime_error("cannot read " + path);
      files.push_back({path, {std::istreambuf_iterator<char>(stream), {}}});
    }
  }
  const auto n_sources =
      std::count_if(files.begin(), files.end(), [](const auto& f) { return is_code(f.path); });
  if (n_sources < 20) throw std::runtime_error("no source tree at " + top_level);
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

struct Include {
  int line;
  char bracket;  ///< '<' or '"'
  std::string header;
};
inline std::vector<Include> includes_of(const SourceFile& file) {
  static const std::regex directive(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  std::vector<Include> includes;
  std::istringstream stream(file.text);
  std::smatch match;
  int n = 0;
  for (std::string line; std::getline(stream, line);) {
    ++n;
    if (line.find("include") == std::string::npos) continue;
    if (std::regex_match(line, match, directive))
      includes.push_back({n, match[1].str()[0], match[2].str()});
  }
  return includes;
}

inline std::string place(const SourceFile& file, int line) {
  return file.path + ":" + std::to_string(line) + ": ";
}

/// Project includes point left or down the list of rooms, are written from the top level, and
/// exist.
/// @param known paths of all files of the tree
inline Complaints include_direction(const SourceFile& file, const std::set<std::string>& known) {
  Complaints complaints;
  if (!is_code(file.path)) return complaints;
  const std::string room = room_of(file.path);
  if (room.empty()) return {place(file, 1) + "lies in no room"};
  for (const auto& include : includes_of(file)) {
    if (include.bracket == '<') continue;
    const std::string target = room_of(include.header);
    const std::string at = place(file, include.line);
    if (target.empty()) {
      complaints.push_back(at + "write \"" + include.header + "\" from the top level");
    } else if (known.count(include.header) == 0) {
      complaints.push_back(at + "no file " + include.header);
    } else if (target != room && permitted_rooms().at(room).count(target) == 0) {
      complaints.push_back(at + room + " must not include " + target);
    }
  }
  return complaints;
}

/// A library: what its headers look like, and the paths that may include them.
struct Library {
  const char* headers;
  const char* paths;
};
inline const std::vector<Library>& libraries() {
  static const std::vector<Library> table = {
      {R"([a-z_0-9]+)", ".*"},  // the standard library
      {R"((sys/.*|fcntl|malloc|sched|spawn|unistd|signal|poll|dlfcn)\.h)", ".*"},
      {R"((elf|link)\.h)", R"(benchmarks/run/provenance\.cpp)"},
      {R"(linux/.*\.h)", R"(meshes/geo/jail\.cpp)"},
      {R"(fmt/.*)", ".*"},
      {R"(Eigen/.*)",
       R"(common/algebra/vectors\.hpp|common/closure/\w+\.cpp|)"
       R"((sph|fvm|meshes|tests/graphs|common/(run|exact|cases|functions))/.*\.cpp)"},
      {R"(hdf5\.h)", "(tests/)?common/io/.*"},
      {R"(toml\+\+/.*)", "common/cases/.*"},
      {R"(muParser\.h)", "(tests/)?common/functions/.*"},
      {R"(xxhash\.h)", "common/(run|cases|io)/.*"},
      {R"(omp\.h)", "common/parallel/.*"},
      {R"((mpi|metis)\.h)", "common/mpi/.*"},
      {R"(gmsh\.h)", "meshes/.*"},
      {R"(nlohmann/.*)", "(common/io|postprocess|tests|benchmarks)/.*"},
      {R"(pugixml\.hpp)", "(tests|benchmarks/regression)/.*\\.cpp"},
      {R"(yaml-cpp/.*)", "tests/.*"},
      {R"((vtk\w+|X11/Xlib)\.h)", "postprocess/pictures/.*"},
      {R"(CLI/.*)", R"((benchmarks|postprocess/pictures)/.*\.cpp)"},
      {R"(benchmark/.*)", "benchmarks/micro/.*"},
      {R"((gtest|gmock)/.*)", "tests/.*"}};
  return table;
}

/// Third-party headers stand in their library's room only; a header of no known library is refused.
inline Complaints third_party_rooms(const SourceFile& file) {
  Complaints complaints;
  if (!is_code(file.path)) return complaints;
  for (const auto& include : includes_of(file)) {
    if (include.bracket == '"') continue;
    const auto library = std::find_if(libraries().begin(), libraries().end(), [&](const auto& l) {
      return std::regex_match(include.header, std::regex(l.headers));
    });
    const std::string header = "<" + include.header + ">";
    if (library == libraries().end()) {
      complaints.push_back(place(file, include.line) + header + " is of an unknown library");
    } else if (!std::regex_match(file.path, std::regex(library->paths))) {
      complaints.push_back(place(file, include.line) + header + " belongs into " + library->paths);
    }
  }
  return complaints;
}

/// At most 450 lines; headers start with #pragma once and a /// description.
inline Complaints file_shape(const SourceFile& file) {
  constexpr int most_lines = 450;
  Complaints complaints;
  if (!is_code(file.path)) return complaints;
  const auto n_lines = std::count(file.text.begin(), file.text.end(), '\n');
  if (n_lines > most_lines) {
    complaints.push_back(place(file, most_lines) + "has " + std::to_string(n_lines) +
                         " lines; split it (one idea per file, at most " +
                         std::to_string(most_lines) + ")");
  }
  if (std::filesystem::path(file.path).extension() != ".hpp") return complaints;
  std::istringstream stream(file.text);
  std::string first, second;
  std::getline(stream, first);
  while (std::getline(stream, second) && second.empty()) {
  }
  if (first != "#pragma once") complaints.push_back(place(file, 1) + "start with #pragma once");
  if (second.rfind("/// ", 0) != 0 && first.rfind("/// ", 0) != 0)
    complaints.push_back(place(file, 2) + "open with a /// description of what the file is");
  return complaints;
}

/// No note of unfinished work.
inline Complaints unfinished_work(const SourceFile& file) {
  static const std::regex note(
      "\\b(TO"
      "DO|FIX"
      "ME)\\b");
  Complaints complaints;
  std::istringstream stream(file.text);
  int n = 0;
  for (std::string line; std::getline(stream, line);) {
    ++n;
    if (std::regex_search(line, note))
      complaints.push_back(place(file, n) + "finish it, or write an issue");
  }
  return complaints;
}

/// Numbers of the sections of a page: "3.3" of its heading "### 3.3 Closure at the boundary".
inline std::set<std::string> section_numbers(const std::string& page) {
  static const std::regex heading(R"(#+ (\d+(\.\d+)*) .*)");
  std::set<std::string> numbers;
  std::istringstream stream(page);
  std::smatch match;
  for (std::string line; std::getline(stream, line);) {
    if (std::regex_match(line, match, heading)) numbers.insert(match[1].str());
  }
  return numbers;
}

/// Sections of the physics notes that a file cites, as "notes 3.3" or "notes 3.1, 3.3", are there.
/// A line may end between word and number.
/// @param sections  of common/physics/notes.md
inline Complaints cited_notes(const SourceFile& file, const std::set<std::string>& sections) {
  static const std::regex citation(R"(\bnotes?[\s/]+(\d+(\.\d+)*((,| and)[\s/]+\d+\.\d+)*))");
  static const std::regex number(R"(\d+(\.\d+)*)");
  const std::string& text = file.text;
  const std::sregex_iterator end{};
  Complaints complaints;
  for (std::sregex_iterator cited(text.begin(), text.end(), citation); cited != end; ++cited) {
    const auto line = 1 + std::count(text.begin(), text.begin() + cited->position(), '\n');
    const std::string list = cited->str(1);
    for (std::sregex_iterator n(list.begin(), list.end(), number); n != end; ++n) {
      if (sections.count(n->str()) > 0) continue;
      complaints.push_back(place(file, static_cast<int>(line)) +
                           "common/physics/notes.md has no section " + n->str());
    }
  }
  return complaints;
}

/// What the opening of a header names as its test is there: a file, or the folder of some.
/// @param known  all source files
inline Complaints cited_tests(const SourceFile& file, const std::set<std::string>& known) {
  static const std::regex citation(R"(\btests/[\w./]*\w)");
  const std::string opening = file.text.substr(0, file.text.find("\n\n"));
  if (!file.path.ends_with(".hpp") || opening.find("Test") == std::string::npos) return {};
  Complaints complaints;
  for (std::sregex_iterator cited(opening.begin(), opening.end(), citation), end; cited != end;
       ++cited) {
    const std::string path = cited->str();
    const auto inside = known.lower_bound(path + "/");
    if (known.contains(path) || (inside != known.end() && inside->starts_with(path + "/")))
      continue;
    complaints.push_back(file.path + ": names a test that is not there: " + path);
  }
  return complaints;
}

}  // namespace diptych::tests
