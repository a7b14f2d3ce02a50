#pragma once
/// Values of a case file as numbers, names and expressions, each checked against its entry in the
/// table of keys. Messages name the place, the key, what was found, what is admissible.
/// Test: tests/common/cases/reader_test.cpp.

#include "common/cases/document.hpp"
#include "common/cases/keys.hpp"
#include "common/exact/manufactured/motion.hpp"
#include "common/functions/expressions.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych::cases {

using algebra::Vec3;

/// @throws base::InputError on the first key that the table does not know, with the nearest one
void check_keys(const Value& document);

/// Applies "key=value" overrides; the keys must be in the table, those that the user names
/// (parameters, functions) in the document, and each may be set once.
/// @throws base::InputError
void apply_overrides(Value& document, const std::vector<std::string>& overrides);

/// One section of the file: [section], or an entry of [[section]].
class SectionValues {
 public:
  /// @param table  null where the file has no such section: defaults hold
  /// @param path   "mesh", "material.branch.0"
  SectionValues(const Value& document,
                const Value* table,
                std::string path,
                const functions::Vocabulary& vocabulary,
                int dimension);

  bool has(const std::string& name) const { return find(name) != nullptr; }
  /// Place of a value, of the section where it is missing.
  functions::SourcePlace where(const std::string& name) const;
  functions::SourcePlace where() const;
  std::string path_of(const std::string& name) const {
    return path_.empty() ? name : path_ + "." + name;
  }

  /// Each returns the default of the table where the key is missing.
  /// @throws base::InputError on a missing key without default, a wrong type, range or name
  double number(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;
  bool flag(const std::string& name) const;
  std::string text(const std::string& name) const;
  std::string menu_name(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;  ///< empty where missing
  std::vector<std::string> groups(const std::string& name) const;
  std::vector<double> numbers(const std::string& name) const;
  /// d numbers; the third is `third` in 2-D.
  Vec3 vector(const std::string& name, const Vec3& standard, double third) const;
  Vec3 required_vector(const std::string& name) const;  ///< 0 as the third in 2-D
  Vec3 direction(const std::string& name) const;        ///< the same as a unit vector, not 0
  std::vector<std::int64_t> counts(const std::string& name) const;  ///< d of them
  functions::Expression scalar_field(const std::string& name) const;
  /// With more names than those of the case.
  functions::Expression scalar_field(const std::string& name,
                                     const functions::Vocabulary& vocabulary) const;
  functions::VectorExpression vector_field(const std::string& name) const;  ///< zero where missing
  /// The entries of vector_field as they were written.
  std::vector<exact::ExpressionText> vector_texts(const std::string& name) const;
  /// Whether the value is this word, without being an expression.
  bool is_word(const std::string& name, const std::string& word) const;
  std::optional<functions::VectorExpression> vector_field_if(const std::string& name) const;
  /// 3x3, or in 2-D where `plane` 2x2 with 1 in the third place of the diagonal.
  std::optional<functions::TensorExpression> tensor_field_if(const std::string& name,
                                                             bool plane) const;

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

  const Value& document_;
  const Value* table_;
  std::string path_;
  const functions::Vocabulary& vocabulary_;
  int dimension_;
};

}  // namespace diptych::cases
