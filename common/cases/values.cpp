#include "common/cases/values.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace diptych::cases {

namespace {

[[noreturn]] void unknown_key(const Member& member, const std::string& path) {
  throw base::InputError(fmt::format("{}unknown key '{}'{}", functions::prefix(member.where),
                                     shown(path), key_suggestion(table_path(path))));
}

void check_table(const Value& table, const std::string& path);

/// A section must be a table, a [[section]] a list of tables.
void check_section(const Member& member, const Section& section, const std::string& path) {
  const Value& value = member.value;
  if (section.is_list && value.kind == Value::Kind::list) {
    for (size_t i = 0; i < value.elements.size(); ++i) {
      const Value& entry = value.elements[i];
      if (entry.kind != Value::Kind::table) {
        throw base::InputError(fmt::format("{}entry {} of {} is {}; write [[{}]]",
                                           functions::prefix(entry.where), i, path,
                                           described(entry), path));
      }
      check_table(entry, fmt::format("{}.{}", path, i));
    }
  } else if (!section.is_list && value.kind == Value::Kind::table) {
    check_table(value, path);
  } else {
    throw base::InputError(fmt::format("{}{} is {}; write {}{}{}", functions::prefix(value.where),
                                       path, described(value), section.is_list ? "[[" : "[", path,
                                       section.is_list ? "]]" : "]"));
  }
}

void check_table(const Value& table, const std::string& path) {
  const Section functions{"functions", false, ""};
  for (const Member& member : table.members) {
    const std::string child = path.empty() ? member.name : path + "." + member.name;
    // Quoted names with points and the like would pass for paths.
    if (!functions::is_name(member.name)) unknown_key(member, child);
    const std::string known = table_path(child);
    if (find_key(known) != nullptr) continue;
    const Section* section = child == "functions" ? &functions : find_section(known);
    if (section == nullptr) unknown_key(member, child);
    check_section(member, *section, child);
  }
}

/// Of a key parameters.NAME or functions.NAME.x: the file must have that name.
void check_user_name(const Value& document, const std::string& key, const std::string& where) {
  const std::string section = key.substr(0, key.find('.'));
  if (section != "parameters" && section != "functions") return;
  const size_t begin = section.size() + 1;
  const std::string name = key.substr(begin, key.find('.', begin) - begin);
  std::vector<std::string> names;
  if (const Member* table = document.find(section)) {
    for (const Member& m : table->value.members)
      names.push_back(m.name);
  }
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw base::InputError(where + "the case file has no '" + shown(name) + "' in [" + section + "]" +
                         (names.empty() ? "" : base::suggestion(name, names)));
}

bool is_constant(const functions::Expression& expression, double value) {
  return !expression.depends_on_time() && !expression.depends_on_position() &&
         expression(Vec3::Zero(), 0) == value;
}

}  // namespace

void check_keys(const Value& document) {
  check_table(document, "");
}

void apply_overrides(Value& document, const std::vector<std::string>& overrides) {
  std::set<std::string> seen;
  for (const std::string& assignment : overrides) {
    const std::string key = key_of(assignment);
    const std::string where = "--set " + shown(assignment) + ": ";
    const std::string known = table_path(key);
    if (find_section(known) != nullptr || known == "functions")
      throw base::InputError(where + "'" + key + "' is a section; set its keys one by one");
    if (known.rfind("record.", 0) == 0)
      throw base::InputError(where + "[record] says where a copy is from and cannot be set");
    if (find_key(known) == nullptr)
      throw base::InputError(where + "unknown key '" + shown(key) + "'" + key_suggestion(known));
    if (!seen.insert(key).second) throw base::InputError(where + "'" + key + "' is set twice");
    for (const std::string& other : seen) {
      if (key == other || !are_of_one_value(key, other)) continue;
      throw base::InputError(where + "'" + std::max(key, other) + "' is a part of '" +
                             std::min(key, other) + "', which is set too; set the whole once");
    }
    check_user_name(document, key, where);
    override_value(document, assignment);
  }
}

const Value* Reading::table(const std::string& name) const {
  const Member* member = document.find(name);
  return member == nullptr ? nullptr : &member->value;
}

SectionValues Reading::section(const std::string& name) const {
  return {*this, name.empty() ? &document : table(name), name};
}

std::vector<SectionValues> Reading::entries(const std::string& path) const {
  const size_t dot = path.find('.');
  const Value* list = table(path.substr(0, dot));
  if (list != nullptr && dot != std::string::npos) {
    const Member* member = list->find(path.substr(dot + 1));
    list = member == nullptr ? nullptr : &member->value;
  }
  std::vector<SectionValues> all;
  for (size_t i = 0; list != nullptr && i < list->elements.size(); ++i)
    all.emplace_back(*this, &list->elements[i], fmt::format("{}.{}", path, i));
  return all;
}

const Value* SectionValues::find(const std::string& name) const {
  const Member* member = table_ == nullptr ? nullptr : table_->find(name);
  return member == nullptr ? nullptr : &member->value;
}

const Key& SectionValues::key(const std::string& name) const {
  return key_at(table_path(path_of(name)));
}

functions::SourcePlace SectionValues::where() const {
  return table_ == nullptr ? reading_.document.where : table_->where;
}

functions::SourcePlace SectionValues::where(const std::string& name) const {
  const Value* value = find(name);
  return value == nullptr ? where() : value->where;
}

void SectionValues::fail(const std::string& name, const std::string& reason) const {
  throw base::InputError(functions::prefix(where(name)) + path_of(name) + " " + reason);
}

void SectionValues::refuse(const std::string& name, const std::string& reason) const {
  if (has(name)) fail(name, reason);
}

bool SectionValues::is_wanted(const std::string& name) const {
  return has(name) || key(name).presence == Presence::required;
}

const Value& SectionValues::required(const std::string& name) const {
  const Value* value = find(name);
  if (value == nullptr) {
    fail(name, fmt::format("is missing; write {} = {}", name, key(name).example));
  }
  return *value;
}

void SectionValues::wrong_type(const Value& value, const std::string& name) const {
  const Key& entry = key(name);
  std::string takes = type_name(entry.type);
  const std::vector<std::string>& menu = names_of(entry, reading_.menus);
  if (!menu.empty()) takes += " (" + base::joined(menu) + ")";
  throw base::InputError(fmt::format("{}{} is {}; it takes {}, as in {} = {}",
                                     functions::prefix(value.where), path_of(name),
                                     described(value), takes, name, entry.example));
}

double SectionValues::number_of(const Value& value, const std::string& name) const {
  double result = 0;
  if (value.kind == Value::Kind::integer) {
    result = static_cast<double>(value.integer);
  } else if (value.kind == Value::Kind::real) {
    result = value.real;
  } else if (value.kind == Value::Kind::text) {
    result =
        functions::constant_value(value.text, reading_.vocabulary.parameters, value.text_where);
  } else {
    wrong_type(value, name);
  }
  const Key& entry = key(name);
  const std::string unit = entry.unit == "-" ? "" : fmt::format(" {}", entry.unit);
  const std::string found =
      fmt::format("{}{} = {}{}", functions::prefix(value.where), path_of(name), result, unit);
  if (std::fpclassify(result) == FP_SUBNORMAL)
    throw base::InputError(found + " is too small for full precision; use 0 or change the units");
  if (!entry.range.admits(result)) {
    throw base::InputError(found + " is not admissible; it must be " + entry.range.text() +
                           (entry.advice.empty() ? "" : ": " + entry.advice));
  }
  return result;
}

std::int64_t SectionValues::integer_of(const Value& value, const std::string& name) const {
  if (value.kind == Value::Kind::real) wrong_type(value, name);
  const double result = number_of(value, name);
  constexpr double greatest = 9007199254740992;  // 2^53: doubles beyond skip integers
  if (result != std::floor(result) || std::abs(result) > greatest) {
    throw base::InputError(fmt::format("{}{} = {} is not an integer of at most 2^53",
                                       functions::prefix(value.where), path_of(name), result));
  }
  return static_cast<std::int64_t>(result);
}

double SectionValues::number(const std::string& name) const {
  return number_of(required(name), name);
}

std::int64_t SectionValues::integer(const std::string& name) const {
  return integer_of(required(name), name);
}

bool SectionValues::flag(const std::string& name) const {
  const Value& value = required(name);
  if (value.kind != Value::Kind::flag) wrong_type(value, name);
  return value.flag;
}

std::string SectionValues::text(const std::string& name) const {
  const Value& value = required(name);
  if (value.kind != Value::Kind::text) wrong_type(value, name);
  const bool is_plain = std::all_of(value.text.begin(), value.text.end(),
                                    [](unsigned char c) { return c >= 0x20 && c != 0x7F; });
  if (!is_plain) fail(name, "holds control characters");
  return value.text;
}

std::string SectionValues::menu_name(const std::string& name) const {
  const std::string found = text(name);
  const std::vector<std::string>& menu = names_of(key(name), reading_.menus);
  // a menu that is not known here is asked by who takes the name
  if (menu.empty() || std::find(menu.begin(), menu.end(), found) != menu.end()) return found;
  fail(name,
       fmt::format("= '{}' is not on its menu{}", shown(found), base::suggestion(found, menu)));
}

const std::vector<Value>& SectionValues::entries(const Value& value,
                                                 const std::string& name,
                                                 int n) const {
  if (value.kind != Value::Kind::list) wrong_type(value, name);
  if (static_cast<int>(value.elements.size()) != n) {
    throw base::InputError(fmt::format("{}{} has {} entries; in this {}-D case it takes {}",
                                       functions::prefix(value.where), path_of(name),
                                       value.elements.size(), reading_.dimension, n));
  }
  return value.elements;
}

std::vector<std::string> SectionValues::groups(const std::string& name) const {
  const Value& value = required(name);
  std::vector<Value> list = value.elements;
  if (value.kind == Value::Kind::text) list = {value};
  std::vector<std::string> names;
  for (const Value& entry : list) {
    if (entry.kind != Value::Kind::text) wrong_type(value, name);
    if (entry.text.empty()) fail(name, "holds an empty name; name a group of the mesh");
    if (std::find(names.begin(), names.end(), entry.text) != names.end())
      fail(name, fmt::format("names '{}' twice", shown(entry.text)));
    names.push_back(entry.text);
  }
  if (value.kind != Value::Kind::text && value.kind != Value::Kind::list) wrong_type(value, name);
  if (names.empty()) fail(name, "is empty; name a group of the mesh, as in group = \"x_min\"");
  return names;
}

std::vector<std::string> SectionValues::texts(const std::string& name) const {
  const Value& value = required(name);
  if (value.kind != Value::Kind::list) wrong_type(value, name);
  std::vector<std::string> list;
  for (const Value& entry : value.elements) {
    if (entry.kind != Value::Kind::text) wrong_type(entry, name);
    list.push_back(entry.text);
  }
  return list;
}

std::vector<double> SectionValues::numbers(const std::string& name) const {
  const Value& value = required(name);
  if (value.kind != Value::Kind::list) wrong_type(value, name);
  std::vector<double> result;
  for (const Value& entry : value.elements)
    result.push_back(number_of(entry, name));
  return result;
}

Vec3 SectionValues::vector(const std::string& name) const {
  Vec3 result = Vec3::Zero();
  const std::vector<Value>& list = entries(required(name), name, reading_.dimension);
  for (int i = 0; i < reading_.dimension; ++i)
    result[i] = number_of(list[static_cast<size_t>(i)], name);
  return result;
}

Vec3 SectionValues::direction(const std::string& name) const {
  const Vec3 value = vector(name);
  if (!(value.norm() > 0)) fail(name, "is no direction; give a vector that is not 0");
  return value.normalized();
}

std::vector<std::int64_t> SectionValues::counts(const std::string& name) const {
  std::vector<std::int64_t> result;
  for (const Value& entry : entries(required(name), name, reading_.dimension))
    result.push_back(integer_of(entry, name));
  return result;
}

functions::Expression SectionValues::field_of(const Value& value,
                                              const std::string& name,
                                              const functions::Vocabulary& vocabulary) const {
  if (value.kind == Value::Kind::text) return {value.text, vocabulary, value.text_where};
  return functions::Expression(number_of(value, name));
}

functions::Expression SectionValues::scalar_field(const std::string& name) const {
  return scalar_field(name, reading_.vocabulary);
}

functions::Expression SectionValues::scalar_field(const std::string& name,
                                                  const functions::Vocabulary& vocabulary) const {
  const Value& value = required(name);
  if (value.kind == Value::Kind::list) fail(name, "is a list; here it takes one expression");
  return field_of(value, name, vocabulary);
}

functions::VectorExpression SectionValues::vector_field(const std::string& name) const {
  const std::vector<Value>& list = entries(required(name), name, reading_.dimension);
  functions::VectorExpression field;
  for (size_t i = 0; i < list.size(); ++i)
    field.component[i] = field_of(list[i], name, reading_.vocabulary);
  return field;
}

std::vector<exact::ExpressionText> SectionValues::vector_texts(const std::string& name) const {
  std::vector<exact::ExpressionText> texts;
  for (const Value& value : entries(required(name), name, reading_.dimension)) {
    const bool is_text = value.kind == Value::Kind::text;
    texts.push_back({is_text ? value.text : fmt::format("{}", number_of(value, name)),
                     is_text ? value.text_where : value.where});
  }
  return texts;
}

bool SectionValues::is_word(const std::string& name, const std::string& word) const {
  const Value* value = find(name);
  return value != nullptr && value->kind == Value::Kind::text && value->text == word;
}

functions::TensorExpression SectionValues::tensor_field(const std::string& name, bool plane) const {
  const Value& value = required(name);
  const bool is_plane = plane && reading_.dimension == 2 && value.elements.size() == 2;
  const int n = is_plane ? 2 : 3;
  const std::vector<Value>& rows = entries(value, name, n);
  functions::TensorExpression field;
  if (is_plane) field.component[8] = functions::Expression(1.0);
  for (int i = 0; i < n; ++i) {
    const std::vector<Value>& row = entries(rows[static_cast<size_t>(i)], name, n);
    for (int j = 0; j < n; ++j)
      field.component[static_cast<size_t>(3 * i + j)] =
          field_of(row[static_cast<size_t>(j)], name, reading_.vocabulary);
  }
  if (plane && reading_.dimension == 2) {
    const auto& f = field.component;
    if (!f[2].is_zero() || !f[5].is_zero() || !f[6].is_zero() || !f[7].is_zero() ||
        !is_constant(f[8], 1))
      fail(name, "leaves the plane; in 2-D its third row and column are 0, 0, 1");
  }
  return field;
}

}  // namespace diptych::cases
