/// Look-ups in the table of keys, and the texts made from it.

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/keys.hpp"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <vector>

namespace diptych::cases {

namespace {

std::vector<std::string> steps_of(std::string_view path) {
  std::vector<std::string> steps(1);
  for (const char c : path) {
    if (c == '.') {
      steps.emplace_back();
    } else {
      steps.back() += c;
    }
  }
  return steps;
}

std::string section_of(std::string_view path) {
  const size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? "" : std::string(path.substr(0, dot));
}

std::string last_of(std::string_view path) {
  return steps_of(path).back();
}

/// "number, m, > 0, default 1"
std::string facts(const Key& key) {
  std::string text = type_name(key.type);
  if (key.unit != "-") text += fmt::format(", {}", key.unit);
  if (!key.range.is_all()) text += ", " + key.range.text();
  if (!key.standard.empty()) text += fmt::format(", default {}", key.standard);
  if (!key.need.empty()) text += fmt::format(", {}", key.need);
  return text;
}

std::string header(const Section& section) {
  const std::string path = section.path == "functions.*" ? "functions.NAME" : section.path;
  return section.is_list ? "[[" + path + "]]" : "[" + path + "]";
}

/// Text of a Markdown table cell.
std::string cell(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|' || c == '*') safe += '\\';
    safe += c;
  }
  return safe;
}

std::string markdown_row(const Key& key, const Menus& menus) {
  std::string standard = key.standard.empty() ? "" : fmt::format("`{}`", key.standard);
  if (!key.need.empty()) standard += (standard.empty() ? "" : "; ") + key.need;
  std::string admissible = key.range.is_all() ? "" : key.range.text();
  const std::vector<std::string>& menu = names_of(key, menus);
  if (!menu.empty()) admissible = base::joined(menu);
  const std::string name = key.path == "parameters.*" ? "NAME" : last_of(key.path);
  return fmt::format("| `{}` | {} | {} | {} | {} | {} | `{} = {}` |\n", name, type_name(key.type),
                     key.unit, cell(standard), cell(admissible), cell(key.meaning), name,
                     key.example);
}

constexpr std::string_view markdown_head =
    "| key | type | unit | default | admissible | meaning | example |\n"
    "|---|---|---|---|---|---|---|\n";

constexpr std::string_view page_head =
    "# Keys of a case file\n\n"
    "Made from the entries in `common/cases/sections`; `diptych explain KEY` prints one of "
    "them.\n\n"
    "A case file is TOML. Unknown, duplicate and ill-typed keys are errors. A number may be "
    "written as\ntext with an expression of parameters and `pi` (`end = \"1.25*2*pi/omega\"`); a "
    "field may use the\nreference position `x`, `y`, `z` (m), the time `t` (s) and the functions "
    "of "
    "time as well.\nOperators: `+ - * / ^`, comparisons, `&& ||`, `condition ? a : b`; functions: "
    "`sin cos tan asin\nacos atan atan2 sinh cosh tanh asinh acosh atanh exp ln log log2 log10 "
    "sqrt "
    "abs sign rint min max\nsum avg`, where `log` is the natural logarithm. Units are SI, or "
    "another "
    "consistent system.\n\n"
    "Every key can be set on the command line: `--set time.end=0.5`, `--set parameters.tau=1e-3`,\n"
    "`--set material.branch.0.tau_C=1e-3` (entries of lists count from 0).\n";

}  // namespace

bool Range::admits(double value) const {
  const bool above_least = least_included ? value >= least : value > least;
  const bool below_most = most_included ? value <= most : value < most;
  return above_least && below_most;
}

std::string Range::text() const {
  const bool has_most = most <= std::numeric_limits<double>::max();
  if (!has_most) return fmt::format("{} {}", least_included ? ">=" : ">", least);
  return fmt::format("in {}{}, {}{}", least_included ? '[' : '(', least, most,
                     most_included ? ']' : ')');
}

std::string table_path(const std::string& path) {
  std::string clean;
  const std::vector<std::string> steps = steps_of(path);
  for (size_t i = 0; i < steps.size(); ++i) {
    const bool is_index =
        !steps[i].empty() &&
        std::all_of(steps[i].begin(), steps[i].end(), [](char c) { return c >= '0' && c <= '9'; });
    const bool is_users = i == 1 && (steps[0] == "parameters" || steps[0] == "functions");
    if (is_index && !is_users && i > 0) continue;
    if (!clean.empty()) clean += '.';
    clean += is_users ? "*" : steps[i];
  }
  return clean;
}

const std::vector<std::string>& names_of(const Key& key, const Menus& menus) {
  const auto above = menus.find(key.path);
  return key.menu.empty() && above != menus.end() ? above->second : key.menu;
}

const Key* find_key(std::string_view path) {
  for (const Key& key : keys()) {
    if (key.path == path) return &key;
  }
  return nullptr;
}

const Section* find_section(std::string_view path) {
  for (const Section& section : sections()) {
    if (section.path == path) return &section;
  }
  return nullptr;
}

const Key& key_at(std::string_view path) {
  const Key* key = find_key(path);
  assert(key != nullptr);
  return *key;
}

std::string key_suggestion(const std::string& path) {
  const std::string section = section_of(path), last = last_of(path);
  std::vector<std::string> siblings, all;
  for (const Section& s : sections()) {
    if (section_of(s.path) == section) siblings.emplace_back(s.path);
    all.emplace_back(s.path);
  }
  for (const Key& key : keys()) {
    if (section_of(key.path) == section) siblings.emplace_back(key.path);
    all.emplace_back(key.path);
    const bool is_users = key.path.find('*') != std::string::npos;
    if (last_of(key.path) == last && !is_users)
      return fmt::format("; did you mean '{}'?", key.path);
  }
  // Whole paths would look alike by their section alone: compare the last words.
  std::vector<std::string> words;
  for (const std::string& sibling : siblings)
    words.push_back(last_of(sibling));
  const std::string nearest = base::nearest_name(last, words);
  if (!nearest.empty()) {
    const auto at = std::find(words.begin(), words.end(), nearest) - words.begin();
    return fmt::format("; did you mean '{}'?", siblings[static_cast<size_t>(at)]);
  }
  if (!siblings.empty()) return "; known: " + base::joined(siblings);
  return base::suggestion(path, all);
}

std::string type_name(KeyType type) {
  switch (type) {
    case KeyType::text:
      return "text";
    case KeyType::path:
      return "path";
    case KeyType::name:
      return "name";
    case KeyType::texts:
      return "list of texts";
    case KeyType::groups:
      return "name or list of names";
    case KeyType::flag:
      return "true or false";
    case KeyType::number:
      return "number";
    case KeyType::integer:
      return "integer";
    case KeyType::numbers:
      return "list of numbers";
    case KeyType::vector:
      return "vector";
    case KeyType::counts:
      return "list of integers";
    case KeyType::scalar_field:
      return "expression";
    case KeyType::vector_field:
      return "vector of expressions";
    case KeyType::tensor_field:
      return "rows of expressions";
  }
  return "";
}

std::string explain(const std::string& path, const Menus& menus) {
  const std::string wanted = table_path(path);
  if (const Key* key = find_key(wanted)) {
    std::string text = fmt::format("{}: {}\n{}\n", path, facts(*key), key->meaning);
    const std::vector<std::string>& menu = names_of(*key, menus);
    if (!menu.empty()) text += fmt::format("one of: {}\n", base::joined(menu));
    if (!key->advice.empty()) text += fmt::format("note: {}\n", key->advice);
    const std::string name = wanted == "parameters.*" ? "NAME" : last_of(wanted);
    return text + fmt::format("example: {} = {}\n", name, key->example);
  }
  const Section* section = find_section(wanted == "functions" ? "functions.*" : wanted);
  if (section == nullptr)
    throw base::InputError("unknown key '" + path + "'" + key_suggestion(wanted));
  std::string text = fmt::format("{} {}\n", header(*section), section->meaning);
  for (const Key& key : keys()) {
    if (section_of(key.path) == section->path)
      text += fmt::format("  {}: {}\n", last_of(key.path), facts(key));
  }
  return text;
}

std::string reference_page(const Menus& menus) {
  std::string page(page_head);
  page += fmt::format("\n## Top of the file\n\n{}", markdown_head);
  for (const Key& key : keys()) {
    if (section_of(key.path).empty()) page += markdown_row(key, menus);
  }
  for (const Section& section : sections()) {
    page +=
        fmt::format("\n## `{}`\n\n{}\n\n{}", header(section), cell(section.meaning), markdown_head);
    for (const Key& key : keys()) {
      if (section_of(key.path) == section.path) page += markdown_row(key, menus);
    }
  }
  return page;
}

}  // namespace diptych::cases
