#pragma once
/// A case file as a tree of values with their places, in the order of the file, after the overrides
/// of the command line. Knows TOML and nothing of what the keys mean.
/// Test: tests/common/cases/reader_test.cpp.

#include "common/functions/expressions.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::cases {

struct Member;

/// One value of a case file.
struct Value {
  enum class Kind { flag, integer, real, text, list, table, date };
  Kind kind = Kind::table;
  functions::SourcePlace where;       ///< of the value; of the header for [tables]
  functions::SourcePlace text_where;  ///< of the first character inside the quotes, for text
  bool flag = false;
  std::int64_t integer = 0;
  double real = 0;
  std::string text;
  std::vector<Value> elements;  ///< of a list
  std::vector<Member> members;  ///< of a table, as written

  const Member* find(const std::string& name) const;
  Member* find(const std::string& name);
};

struct Member {
  std::string name;
  functions::SourcePlace where;  ///< of the name
  Value value;
};

/// "text 'abc'", "the number 3.5", "a list of 3": what a value is, for messages.
std::string described(const Value& value);

/// Text fit for a message: control characters as '?', at most 60 characters.
std::string shown(const std::string& text);

/// @param file name for the places
/// @throws base::InputError with file:line:column on what is not TOML, duplicate keys, nan, inf
Value parse_document(const std::string& text, const std::string& file);

/// Sets one value: "material.poissons_ratio=0.45", "mesh.cells=[8, 8, 8]",
/// "material.branch.0.tau_C=1e-3", "mesh.element=tetrahedron" (text needs no quotes). Missing
/// tables are made; entries of lists must exist.
/// @throws base::InputError
void override_value(Value& document, const std::string& assignment);

/// Key of "key=value", blanks removed. @throws base::InputError where '=' or the key is missing
std::string key_of(const std::string& assignment);

/// Whether two keys say something of the same: one of a list and one of its entries, too.
bool are_of_one_value(const std::string& key, const std::string& other);

}  // namespace diptych::cases
