#include "benchmarks/run/toml_table.hpp"

#include "benchmarks/terminal/text.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <fmt/format.h>

namespace diptych::harness {

using cases::Value;

void toml_fail(const functions::SourcePlace& where, const std::string& what) {
  throw base::InputError(functions::prefix(where) + what);
}

TomlTable::TomlTable(const Value& table, std::string name, const std::vector<std::string>& known)
    : table_(table), name_(std::move(name)) {
  if (table.kind != Value::Kind::table)
    toml_fail(table.where, name_ + " must be a table, not " + cases::described(table));
  for (const cases::Member& member : table.members) {
    if (contains(known, member.name)) continue;
    toml_fail(member.where, fmt::format("unknown key '{}' of {}{}", member.name, name_,
                                        base::suggestion(member.name, known)));
  }
}

const Value* TomlTable::find(const std::string& key) const {
  const cases::Member* member = table_.find(key);
  return member == nullptr ? nullptr : &member->value;
}

const Value& TomlTable::at(const std::string& key) const {
  const Value* value = find(key);
  if (value == nullptr) toml_fail(table_.where, fmt::format("{} lacks '{}'", name_, key));
  return *value;
}

std::string TomlTable::text(const std::string& key) const {
  return text_of(at(key), key);
}

std::string TomlTable::text(const std::string& key, const std::string& standard) const {
  return find(key) == nullptr ? standard : text(key);
}

bool TomlTable::flag(const std::string& key) const {
  const Value* value = find(key);
  if (value != nullptr && value->kind != Value::Kind::flag) wrong(*value, key, "true or false");
  return value != nullptr && value->flag;
}

int TomlTable::count(const std::string& key, int standard) const {
  const Value* value = find(key);
  return value == nullptr ? standard : count_of(*value, key);
}

std::vector<std::string> TomlTable::texts(const std::string& key) const {
  std::vector<std::string> all;
  for (const Value& value : list(key))
    all.push_back(text_of(value, key));
  return all;
}

std::vector<int> TomlTable::counts(const std::string& key) const {
  std::vector<int> all;
  for (const Value& value : list(key))
    all.push_back(count_of(value, key));
  return all;
}

std::vector<Value> TomlTable::list(const std::string& key) const {
  const Value* value = find(key);
  if (value == nullptr) return {};
  if (value->kind != Value::Kind::list) wrong(*value, key, "a list");
  return value->elements;
}

void TomlTable::wrong(const Value& value,
                      const std::string& key,
                      const std::string& expected) const {
  toml_fail(value.where, fmt::format("'{}' of {} must be {}, not {}", key, name_, expected,
                                     cases::described(value)));
}

std::string TomlTable::text_of(const Value& value, const std::string& key) const {
  if (value.kind != Value::Kind::text) wrong(value, key, "a text");
  return value.text;
}

int TomlTable::count_of(const Value& value, const std::string& key) const {
  if (value.kind != Value::Kind::integer || value.integer < 0 || value.integer > 1000)
    wrong(value, key, "a whole number from 0 to 1000");
  return static_cast<int>(value.integer);
}

std::string assigned(const Value& value) {
  switch (value.kind) {
    case Value::Kind::text:
      return value.text;
    case Value::Kind::integer:
      return fmt::format("{}", value.integer);
    case Value::Kind::real:
      return fmt::format("{}", value.real);
    case Value::Kind::flag:
      return value.flag ? "true" : "false";
    default:
      toml_fail(value.where, "a value to vary must be a number or a text");
  }
}

}  // namespace diptych::harness
