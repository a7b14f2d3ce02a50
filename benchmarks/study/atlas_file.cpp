/// Reads the file of an atlas.

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/data_folder.hpp"
#include "benchmarks/run/toml_table.hpp"
#include "benchmarks/study/atlas.hpp"
#include "benchmarks/terminal/text.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/bound.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;
using cases::Value;

/// Where the names of cases in an atlas are looked up.
struct CasePlaces {
  fs::path folder;           ///< of the atlas
  std::string cases_folder;  ///< of --cases

  std::string file(const TomlTable& table) const {
    const std::string word = table.text("case");
    const fs::path beside = folder / word;
    std::error_code error;
    const bool is_path = word.find('/') != std::string::npos || beside.extension() == ".toml";
    try {
      return find_case(is_path && fs::exists(beside, error) ? beside.string() : word, cases_folder);
    } catch (const base::InputError& failure) {
      toml_fail(table.at("case").where, failure.what());
    }
  }
};

std::vector<std::string> methods_of(const TomlTable& table,
                                    const std::vector<std::string>& standard) {
  if (table.find("methods") == nullptr) return standard;
  const std::vector<std::string> methods = table.texts("methods"), known = method_menu().names();
  for (const std::string& method : methods) {
    if (!contains(known, method)) {
      toml_fail(table.at("methods").where,
                "unknown method '" + method + "'" + base::suggestion(method, known));
    }
  }
  return methods;
}

/// Of a method none of whose choices is marked, the first and the last become part of the coarse
/// map.
void mark_ends(std::vector<AtlasChoice>& choices, const std::vector<std::string>& methods) {
  for (const std::string& method : methods) {
    std::vector<AtlasChoice*> own;
    for (AtlasChoice& choice : choices) {
      if (contains(choice.methods, method)) own.push_back(&choice);
    }
    const bool any = std::any_of(own.begin(), own.end(),
                                 [](const AtlasChoice* choice) { return choice->is_coarse; });
    if (any || own.empty()) continue;
    own.front()->is_coarse = own.back()->is_coarse = true;
  }
}

std::vector<AtlasChoice> read_values(const TomlTable& axis,
                                     const std::vector<std::string>& methods) {
  std::vector<AtlasChoice> choices;
  std::vector<std::string> names;
  for (const Value& value : axis.list("values")) {
    names.push_back(assigned(value));
    choices.push_back({names.back(), {axis.text("key") + "=" + names.back()}, methods, "", false});
  }
  std::vector<std::string> coarse;
  for (const Value& value : axis.list("coarse")) {
    coarse.push_back(assigned(value));
    if (!contains(names, coarse.back())) {
      toml_fail(value.where, fmt::format("coarse value {} is none of the values{}", coarse.back(),
                                         base::suggestion(coarse.back(), names)));
    }
  }
  for (AtlasChoice& choice : choices)
    choice.is_coarse = contains(coarse, choice.name);
  mark_ends(choices, methods);
  return choices;
}

std::vector<AtlasChoice> read_choices(const TomlTable& axis,
                                      const std::vector<std::string>& methods,
                                      const CasePlaces& places) {
  std::vector<AtlasChoice> choices;
  for (const Value& value : axis.list("choice")) {
    const TomlTable table(value, "[[axis.choice]]", {"name", "set", "methods", "case", "coarse"});
    choices.push_back({table.text("name"), table.texts("set"), methods_of(table, methods),
                       table.find("case") ? places.file(table) : "", table.flag("coarse")});
  }
  mark_ends(choices, methods);
  return choices;
}

AtlasAxis read_axis(const Value& value,
                    const std::vector<std::string>& methods,
                    const CasePlaces& places) {
  const TomlTable table(value, "[[axis]]", {"name", "key", "values", "coarse", "choice"});
  const bool has_values = table.find("values") != nullptr;
  if (has_values == (table.find("choice") != nullptr))
    toml_fail(value.where, "[[axis]] needs key and values, or [[axis.choice]]");
  AtlasAxis axis{table.text("name"),
                 has_values ? read_values(table, methods) : read_choices(table, methods, places)};
  if (axis.choices.empty()) toml_fail(value.where, "an axis needs a value");
  for (size_t i = 0; i < axis.choices.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (axis.choices[i].name == axis.choices[j].name)
        toml_fail(value.where,
                  fmt::format("'{}' stands twice on the axis {}", axis.choices[i].name, axis.name));
    }
  }
  return axis;
}

void check_columns(const TomlTable& table, const Atlas& atlas) {
  std::vector<std::string> names;
  for (const AtlasAxis& axis : atlas.axes) {
    if (contains(names, axis.name))
      toml_fail(table.at("axis").where, "two axes are called '" + axis.name + "'");
    names.push_back(axis.name);
  }
  for (const std::string& column : atlas.columns) {
    if (!contains(names, column)) {
      toml_fail(table.at("columns").where,
                "'" + column + "' is no axis" + base::suggestion(column, names));
    }
  }
}

std::vector<std::string> shipped_atlases() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_folder("atlas"), error)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string find_atlas(const std::string& word) {
  std::error_code error;
  if (fs::is_regular_file(word, error)) return word;
  const std::vector<std::string> known = shipped_atlases();
  if (contains(known, word)) return (fs::path(data_folder("atlas")) / (word + ".toml")).string();
  throw base::InputError("no atlas '" + word + "'" + base::suggestion(word, known) +
                         "; or give the path of a .toml file");
}

Atlas read_atlas(const std::string& path, const std::string& cases_folder) {
  const Value document = cases::parse_document(io::read_file(path), path);
  const TomlTable table(document, "the file",
                        {"title", "text", "case", "methods", "set", "holds", "columns", "axis"});
  const CasePlaces places{fs::path(path).parent_path(), cases_folder};
  Atlas atlas;
  atlas.file = path;
  atlas.name = fs::path(path).stem().string();
  atlas.title = table.text("title");
  atlas.text = table.text("text", "");
  atlas.case_file = places.file(table);
  atlas.methods = methods_of(table, method_menu().names());
  atlas.set = table.texts("set");
  atlas.columns = table.texts("columns");
  for (const Value& value : table.list("holds")) {
    if (value.kind != Value::Kind::text) table.wrong(value, "holds", "a list of texts");
    atlas.holds.push_back(cases::bound_from_text(value.text, {}, value.where));
  }
  for (const Value& value : table.list("axis"))
    atlas.axes.push_back(read_axis(value, atlas.methods, places));
  if (atlas.axes.empty()) toml_fail(document.where, "an atlas needs an [[axis]]");
  check_columns(table, atlas);
  return atlas;
}

std::vector<std::string> settings_of(const Atlas& atlas, const AtlasPoint& point) {
  std::vector<std::string> settings;
  for (size_t axis = 0; axis < atlas.axes.size(); ++axis)
    settings.push_back(atlas.axes[axis].choices[point.choices[axis]].name);
  return settings;
}

std::vector<AtlasPoint> points_of(const Atlas& atlas, const std::string& method, bool coarse) {
  AtlasPoint first;
  first.method = method;
  std::vector<AtlasPoint> points{first};
  for (const AtlasAxis& axis : atlas.axes) {
    std::vector<AtlasPoint> finer;
    for (const AtlasPoint& point : points) {
      for (size_t i = 0; i < axis.choices.size(); ++i) {
        const AtlasChoice& choice = axis.choices[i];
        if (!contains(choice.methods, method) || (coarse && !choice.is_coarse)) continue;
        finer.push_back(point);
        finer.back().choices.push_back(i);
      }
    }
    points = std::move(finer);
  }
  return points;
}

}  // namespace diptych::harness
