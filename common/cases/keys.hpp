#pragma once
/// Every key of a case file in one table: the reader checks against it, `diptych explain` and the
/// reference page are made from it. A new key is one entry in case_keys.cpp and one line in the
/// reader; a new name in a menu is one word below (and its entry in the registry of its room).
/// Test: tests/common/cases/keys_test.cpp.

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace diptych::cases {

/// Names that keys may take.
namespace menus {
using Name = std::string_view;
inline constexpr std::array<Name, 4> elements{"hexahedron", "tetrahedron", "quadrilateral",
                                              "triangle"};
inline constexpr std::array<Name, 4> models{"mooney-rivlin", "neo-hookean", "neo-hookean-isochoric",
                                            "neo-hookean-isochoric-j2"};
inline constexpr std::array<Name, 7> boundaries{
    "traction", "pressure", "fixed", "velocity", "symmetry", "skew-symmetry", "rigid-wall"};
inline constexpr std::array<Name, 6> probe_kinds{"point", "mean",     "integral",
                                                 "least", "greatest", "reaction"};
inline constexpr std::array<Name, 2> internals{"virgin", "relaxed"};
inline constexpr std::array<Name, 3> speeds{"exact", "bound", "linearised"};
inline constexpr std::array<Name, 4> integrators{"leapfrog", "ssp-rk2", "ssp-rk3", "ssp-rk43"};
inline constexpr std::array<Name, 3> unknowns{"F", "FJ", "FHJ"};
inline constexpr std::array<Name, 2> reconstructions{"none", "linear"};
inline constexpr std::array<Name, 4> limiters{"none", "barth-jespersen", "venkatakrishnan",
                                              "sign-preserving"};
inline constexpr std::array<Name, 2> impedances{"isotropic", "exact"};
inline constexpr std::array<Name, 3> precisions{"double", "mixed", "single"};
inline constexpr std::array<Name, 3> kernels{"cubic-spline", "quintic-spline", "wendland-c2"};
inline constexpr std::array<Name, 3> stencils{"edge", "integral", "sbp"};
inline constexpr std::array<Name, 5> functions{"expression", "zener_mode", "zener_slab",
                                               "zener_wave", "uniaxial_wave"};
inline constexpr std::array<Name, 3> signals{"step", "one-minus-cosine", "sine"};
}  // namespace menus

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
  std::string_view path;  ///< section.key; section.*.key where the user names the section
  KeyType type;
  std::string_view unit;      ///< SI; "-" where there is none
  std::string_view standard;  ///< default as it would be written, or empty
  std::string_view need;      ///< where there is no default: "required", "with mesh.file", ...
  Range range;
  std::span<const std::string_view> menu;
  std::string_view meaning;  ///< one sentence
  std::string_view example;  ///< as it would be written after "key = "
  std::string_view advice;   ///< what to do about a number out of range, or empty
};

struct Section {
  std::string_view path;
  bool is_list;  ///< [[section]]
  std::string_view meaning;
};

std::span<const Key> keys();
std::span<const Section> sections();

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
std::string explain(const std::string& path);

/// All keys as a Markdown page.
std::string reference_page();

}  // namespace diptych::cases
