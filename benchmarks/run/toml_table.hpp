#pragma once
/// Tables of TOML files that are no cases: verification tables and atlases. A table knows which
/// keys it may have; messages name file, line and column, and the nearest key.
/// Tests: tests/command_line/verification_test.cpp, tests/harness/atlas_file_test.cpp

#include "common/cases/document.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// @throws base::InputError with the place
[[noreturn]] void toml_fail(const functions::SourcePlace& where, const std::string& what);

class TomlTable {
 public:
  /// @param table  kept by reference
  /// @param name   for messages
  /// @throws base::InputError for what is no table, and for keys that are not `known`
  TomlTable(const cases::Value& table, std::string name, const std::vector<std::string>& known);

  const cases::Value* find(const std::string& key) const;  ///< null where it is missing
  // all below throw base::InputError for a wrong type, and where a key without default is missing
  const cases::Value& at(const std::string& key) const;
  std::string text(const std::string& key) const;
  std::string text(const std::string& key, const std::string& standard) const;
  bool flag(const std::string& key) const;
  int count(const std::string& key, int standard) const;
  std::vector<std::string> texts(const std::string& key) const;
  std::vector<int> counts(const std::string& key) const;
  /// Entries of a list or of [[key]]; none where it is missing.
  std::vector<cases::Value> list(const std::string& key) const;
  [[noreturn]] void wrong(const cases::Value& value,
                          const std::string& key,
                          const std::string& expected) const;

 private:
  std::string text_of(const cases::Value& value, const std::string& key) const;
  int count_of(const cases::Value& value, const std::string& key) const;

  const cases::Value& table_;
  std::string name_;
};

/// A value as --set takes it. @throws base::InputError for lists and tables
std::string assigned(const cases::Value& value);

}  // namespace diptych::harness
