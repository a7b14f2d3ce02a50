#pragma once
/// Every key of a case file in one table: the reader checks against it, `diptych explain` and the
/// reference page are made from it. The keys of a section stand in its file in sections/, each
/// with where its value goes. Test: tests/common/cases/keys_test.cpp.

#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::cases {

enum class KeyType {
  text,          ///< any text
  path,          ///< file, relative to the case file
  name,          ///< one of a menu
  texts,         ///< list of texts
  groups,        ///< a name or a list of names
  flag,          ///< true or false
  number,        ///< number, or text with an expression of parameters
  integer,       ///< the same, whole
  numbers,       ///< list of numbers
  vector,        ///< d numbers
  counts,        ///< d integers
  scalar_field,  ///< number or expression of x, y, z, t
  vector_field,  ///< d of them
  tensor_field   ///< rows of them
};

/// What holds where a key is missing.
enum class Presence {
  standard,  ///< its default
  required,  ///< nothing: it must be there
  optional   ///< nothing: what it is for is left out
};

/// Admissible numbers.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_included = false;
  bool most_included = false;

  bool admits(double value) const;
  bool is_all() const { return least == -most && most > std::numeric_limits<double>::max(); }
  std::string text() const;  ///< "> 0", "in (-1, 0.5)"
};

struct Key {
  std::string path;  ///< section.key; section.*.key where the user names the section
  KeyType type;
  Presence presence;
  std::string unit;      ///< SI; "-" where there is none
  std::string standard;  ///< default as it would be written, or empty
  std::string need;      ///< where there is no default: "required", "with mesh.file", ...
  Range range;
  std::vector<std::string> menu;  ///< of a name; empty where rooms above this one hold it
  std::string meaning;            ///< one sentence
  std::string example;            ///< as it would be written after "key = "
  std::string advice;             ///< what to do about a number out of range, or empty
};

struct Section {
  std::string path;
  bool is_list;  ///< [[section]]
  std::string meaning;
};

/// The names of the registries that stand in rooms above this one: path of a key -> names.
using Menus = std::map<std::string, std::vector<std::string>>;

const std::vector<Key>& keys();
const std::vector<Section>& sections();

/// The names that a key takes; none where it is no name, or its menu is above and not in `menus`.
const std::vector<std::string>& names_of(const Key& key, const Menus& menus);

/// Table path of a path with the user's names and indices: "material.branch.0.tau_C" ->
/// "material.branch.tau_C", "parameters.E" -> "parameters.*".
std::string table_path(const std::string& path);

/// The entry of a table path, or null.
const Key* find_key(std::string_view path);
const Section* find_section(std::string_view path);

/// The entry of a table path that the reader knows to be there. @pre the path is in the table
const Key& key_at(std::string_view path);

/// "; did you mean 'mesh.cells'?": the nearest key, first in the same section.
std::string key_suggestion(const std::string& path);

std::string type_name(KeyType type);

/// What `diptych explain KEY` prints, of a key or of a section.
/// @throws base::InputError on an unknown key
std::string explain(const std::string& path, const Menus& menus = {});

/// All keys as a Markdown page.
std::string reference_page(const Menus& menus = {});

}  // namespace diptych::cases
