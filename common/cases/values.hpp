#pragma once
/// Values of a case file as numbers, names and expressions, each checked against its entry in the
/// table of keys. Messages name the place, the key, what was found, what is admissible.
/// Test: tests/common/cases/reader_test.cpp.

#include "common/cases/document.hpp"
#include "common/cases/keys.hpp"
#include "common/exact/manufactured/motion.hpp"
#include "common/functions/expressions.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::cases {

using algebra::Vec3;

/// @throws base::InputError on the first key that the table does not know, with the nearest one
void check_keys(const Value& document);

/// Applies "key=value" overrides; the keys must be in the table, those that the user names
/// (parameters, functions) in the document, and each may be set once.
/// @throws base::InputError
void apply_overrides(Value& document, const std::vector<std::string>& overrides);

class SectionValues;

/// A document while it is read: what its sections need to know of those before them.
struct Reading {
  const Value& document;
  const Menus& menus;
  std::filesystem::path folder{};      ///< that relative paths start from
  functions::Vocabulary vocabulary{};  ///< of parameters and functions
  int dimension = 3;

  const Value* table(const std::string& name) const;
  SectionValues section(const std::string& name) const;
  /// Entries of the list at `path`: "probe", "material.branch".
  std::vector<SectionValues> entries(const std::string& path) const;
};

/// One section of the file: [section], or an entry of [[section]].
class SectionValues {
 public:
  /// @param table  null where the file has no such section: defaults hold
  /// @param path   "mesh", "material.branch.0"
  SectionValues(const Reading& reading, const Value* table, std::string path)
      : reading_(reading), table_(table), path_(std::move(path)) {}

  bool has(const std::string& name) const { return find(name) != nullptr; }
  /// Place of a value, of the section where it is missing.
  functions::SourcePlace where(const std::string& name) const;
  functions::SourcePlace where() const;
  std::string path_of(const std::string& name) const {
    return path_.empty() ? name : path_ + "." + name;
  }

  /// Whether the key is there, or must be.
  bool is_wanted(const std::string& name) const;
  KeyType type_of(const std::string& name) const { return key(name).type; }

  /// @throws base::InputError on a missing key, a wrong type, range or name
  double number(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;
  bool flag(const std::string& name) const;
  std::string text(const std::string& name) const;
  std::string menu_name(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;
  std::vector<std::string> groups(const std::string& name) const;
  std::vector<double> numbers(const std::string& name) const;
  Vec3 vector(const std::string& name) const;     ///< d numbers; 0 as the third in 2-D
  Vec3 direction(const std::string& name) const;  ///< the same as a unit vector, not 0
  std::vector<std::int64_t> counts(const std::string& name) const;  ///< d of them
  functions::Expression scalar_field(const std::string& name) const;
  /// With more names than those of the case.
  functions::Expression scalar_field(const std::string& name,
                                     const functions::Vocabulary& vocabulary) const;
  functions::VectorExpression vector_field(const std::string& name) const;
  /// The entries of vector_field as they were written.
  std::vector<exact::ExpressionText> vector_texts(const std::string& name) const;
  /// Whether the value is this word, without being an expression.
  bool is_word(const std::string& name, const std::string& word) const;
  /// 3x3, or in 2-D where `plane` 2x2 with 1 in the third place of the diagonal.
  functions::TensorExpression tensor_field(const std::string& name, bool plane) const;

  /// @throws base::InputError "key has no effect ..." where the key is there
  void refuse(const std::string& name, const std::string& reason) const;
  [[noreturn]] void fail(const std::string& name, const std::string& reason) const;

 private:
  const Value* find(const std::string& name) const;
  const Value& required(const std::string& name) const;
  const Key& key(const std::string& name) const;
  [[noreturn]] void wrong_type(const Value& value, const std::string& name) const;
  double number_of(const Value& value, const std::string& name) const;
  std::int64_t integer_of(const Value& value, const std::string& name) const;
  functions::Expression field_of(const Value& value,
                                 const std::string& name,
                                 const functions::Vocabulary& vocabulary) const;
  const std::vector<Value>& entries(const Value& value, const std::string& name, int n) const;

  const Reading& reading_;
  const Value* table_;
  std::string path_;
};

}  // namespace diptych::cases
