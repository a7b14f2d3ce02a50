/// Reads the file of a verification table.

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/data_folder.hpp"
#include "benchmarks/terminal/text.hpp"
#include "benchmarks/verifier/verification.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/document.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;
using cases::Value;

[[noreturn]] void fail(const functions::SourcePlace& where, const std::string& what) {
  throw base::InputError(functions::prefix(where) + what);
}

/// A table of the file that knows which keys it may have.
class Keys {
 public:
  Keys(const Value& table, std::string name, const std::vector<std::string>& known)
      : table_(table), name_(std::move(name)) {
    if (table.kind != Value::Kind::table)
      fail(table.where, name_ + " must be a table, not " + cases::described(table));
    for (const cases::Member& member : table.members) {
      if (!contains(known, member.name)) {
        fail(member.where, fmt::format("unknown key '{}' of {}{}", member.name, name_,
                                       base::suggestion(member.name, known)));
      }
    }
  }

  const Value* find(const std::string& key) const {
    const cases::Member* member = table_.find(key);
    return member == nullptr ? nullptr : &member->value;
  }
  const Value& at(const std::string& key) const {
    const Value* value = find(key);
    if (value == nullptr) fail(table_.where, fmt::format("{} lacks '{}'", name_, key));
    return *value;
  }
  std::string text(const std::string& key) const { return text_of(at(key), key); }
  std::string text(const std::string& key, const std::string& standard) const {
    return find(key) == nullptr ? standard : text(key);
  }
  bool flag(const std::string& key) const {
    const Value* value = find(key);
    if (value != nullptr && value->kind != Value::Kind::flag) wrong(*value, key, "true or false");
    return value != nullptr && value->flag;
  }
  int count(const std::string& key, int standard) const {
    const Value* value = find(key);
    return value == nullptr ? standard : count_of(*value, key);
  }
  std::vector<std::string> texts(const std::string& key) const {
    std::vector<std::string> all;
    for (const Value& value : list(key))
      all.push_back(text_of(value, key));
    return all;
  }
  std::vector<int> counts(const std::string& key) const {
    std::vector<int> all;
    for (const Value& value : list(key))
      all.push_back(count_of(value, key));
    return all;
  }
  /// Entries of [[key]]; none where it is missing.
  std::vector<Value> list(const std::string& key) const {
    const Value* value = find(key);
    if (value == nullptr) return {};
    if (value->kind != Value::Kind::list) wrong(*value, key, "a list");
    return value->elements;
  }
  [[noreturn]] void wrong(const Value& value,
                          const std::string& key,
                          const std::string& expected) const {
    fail(value.where, fmt::format("'{}' of {} must be {}, not {}", key, name_, expected,
                                  cases::described(value)));
  }

 private:
  std::string text_of(const Value& value, const std::string& key) const {
    if (value.kind != Value::Kind::text) wrong(value, key, "a text");
    return value.text;
  }
  int count_of(const Value& value, const std::string& key) const {
    if (value.kind != Value::Kind::integer || value.integer < 0 || value.integer > 1000)
      wrong(value, key, "a whole number from 0 to 1000");
    return static_cast<int>(value.integer);
  }

  const Value& table_;
  std::string name_;
};

/// A value as --set takes it.
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
      fail(value.where, "a value to vary must be a number or a text");
  }
}

std::map<std::string, double> read_parameters(const Value* section) {
  std::map<std::string, double> parameters;
  if (section == nullptr) return parameters;
  for (const cases::Member& member : section->members) {
    const Value& value = member.value;
    if (!functions::is_name(member.name)) fail(member.where, "'" + member.name + "' is no name");
    const std::string text = assigned(value);
    parameters[member.name] = functions::constant_value(
        text, parameters, value.kind == Value::Kind::text ? value.text_where : value.where);
  }
  return parameters;
}

NodeMeasure read_measure(const Value& value, const std::map<std::string, double>& parameters) {
  const Keys keys(value, "[[measure]]", {"name", "reduce", "value", "where"});
  NodeMeasure measure;
  measure.name = keys.text("name");
  measure.reduce = keys.text("reduce");
  if (!functions::is_name(measure.name))
    fail(keys.at("name").where, "a name has letters, digits and _");
  if (!contains(reductions(), measure.reduce)) {
    fail(keys.at("reduce").where, "unknown reduction '" + measure.reduce + "'" +
                                      base::suggestion(measure.reduce, reductions()));
  }
  const functions::Vocabulary vocabulary = node_vocabulary(parameters);
  measure.value =
      functions::Expression(keys.text("value"), vocabulary, keys.at("value").text_where);
  const std::string where = keys.text("where", "1");
  measure.where = functions::Expression(
      where, vocabulary, keys.find("where") ? keys.at("where").text_where : value.where);
  measure.text = measure.name + '\0' + measure.reduce + '\0' + keys.text("value") + '\0' + where;
  for (const auto& [name, number] : parameters)
    measure.text += fmt::format("{}={};", name, number);
  return measure;
}

void read_vary(const Value& section, VerificationRun& entry) {
  if (section.kind != Value::Kind::table) fail(section.where, "vary must be a table");
  for (const cases::Member& member : section.members) {
    if (member.value.kind != Value::Kind::list || member.value.elements.empty())
      fail(member.value.where, "a varied key needs a list of values");
    std::vector<std::string> values;
    for (const Value& value : member.value.elements)
      values.push_back(assigned(value));
    entry.vary.emplace_back(member.name, values);
    if (entry.levels.size() == 1) entry.levels.assign(values.size(), entry.levels[0]);
    if (values.size() != entry.levels.size()) {
      fail(member.value.where, fmt::format("{} values for {} levels; give one for each",
                                           values.size(), entry.levels.size()));
    }
  }
}

VerificationRun read_run(const Value& value, const Keys& file) {
  const Keys keys(value, "[[run]]", {"name", "case", "levels", "methods", "set", "vary"});
  const auto from = [&](const char* key) -> const Keys& { return keys.find(key) ? keys : file; };
  VerificationRun entry;
  entry.name = keys.text("name");
  entry.case_name = from("case").text("case");
  entry.levels = from("levels").counts("levels");
  entry.methods = from("methods").texts("methods");
  if (entry.levels.empty()) fail(value.where, "[[run]] lacks 'levels'");
  if (entry.methods.empty()) entry.methods = method_menu().names();
  for (const std::string& method : entry.methods) {
    if (!contains(method_menu().names(), method))
      fail(value.where,
           "unknown method '" + method + "'" + base::suggestion(method, method_menu().names()));
  }
  entry.set = file.texts("set");
  for (const std::string& assignment : keys.texts("set"))
    entry.set.push_back(assignment);
  if (const Value* vary = keys.find("vary")) read_vary(*vary, entry);
  try {
    find_case(entry.case_name);
  } catch (const base::InputError& error) {
    fail(value.where, error.what());
  }
  return entry;
}

VerificationColumn read_column(const Value& value, const VerificationTable& table) {
  const Keys keys(
      value, "[[column]]",
      {"title", "value", "order", "ratio_to", "optional", "group", "estimate", "literature"});
  VerificationColumn column;
  column.title = keys.text("title");
  column.value = keys.text("value");
  column.where = keys.at("value").text_where;
  column.order = keys.flag("order");
  column.optional = keys.flag("optional");
  column.ratio_to = keys.text("ratio_to", "");
  column.group = keys.text("group", "");
  column.estimate = keys.flag("estimate");
  column.literature = keys.text("literature", "");
  if (!column.literature.empty() && !column.estimate) {
    fail(keys.at("literature").where,
         "literature stands beside an extrapolated value; add estimate = true");
  }
  std::vector<std::string> names;
  for (const VerificationRun& entry : table.runs)
    names.push_back(entry.name);
  if (!column.ratio_to.empty() && !contains(names, column.ratio_to)) {
    fail(keys.at("ratio_to").where,
         "no run '" + column.ratio_to + "'" + base::suggestion(column.ratio_to, names));
  }
  return column;
}

/// The names in `key`, all of `known` where it is missing.
std::vector<std::string> chosen(const Keys& keys,
                                const char* key,
                                const std::vector<std::string>& known) {
  if (keys.find(key) == nullptr) return known;
  const std::vector<std::string> names = keys.texts(key);
  for (const std::string& name : names) {
    if (!contains(known, name)) {
      fail(keys.at(key).where,
           fmt::format("'{}' is none of the {}{}", name, key, base::suggestion(name, known)));
    }
  }
  return names;
}

VerificationBound read_bound(const Value& value, const VerificationTable& table) {
  using Kind = VerificationBound::Kind;
  static const std::vector<std::pair<std::string, Kind>> kinds{{"least_order", Kind::least_order},
                                                               {"most", Kind::most},
                                                               {"least", Kind::least},
                                                               {"most_spread", Kind::most_spread}};
  const Keys keys(value, "[[bound]]",
                  {"columns", "runs", "least_order", "most", "least", "most_spread"});
  std::vector<std::string> titles, names;
  for (const auto& column : table.columns)
    titles.push_back(column.title);
  for (const auto& entry : table.runs)
    names.push_back(entry.name);
  VerificationBound bound;
  bound.columns = chosen(keys, "columns", titles);
  bound.runs = chosen(keys, "runs", names);
  int n_kinds = 0;
  for (const auto& [key, kind] : kinds) {
    const Value* asked = keys.find(key);
    if (asked == nullptr) continue;
    ++n_kinds;
    if (asked->kind != Value::Kind::real && asked->kind != Value::Kind::integer)
      keys.wrong(*asked, key, "a number");
    bound.kind = kind;
    bound.asked =
        asked->kind == Value::Kind::real ? asked->real : static_cast<double>(asked->integer);
  }
  if (n_kinds != 1)
    fail(value.where, "[[bound]] needs one of least_order, most, least, most_spread");
  return bound;
}

void check_distinct(const functions::SourcePlace& where, const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(name).second) fail(where, "'" + name + "' stands twice; take another name");
  }
}

std::string folder_of(VerificationSet set) {
  const bool literature = set == VerificationSet::literature;
  const char* folder = std::getenv(literature ? "DIPTYCH_LITERATURE" : "DIPTYCH_VERIFICATION");
  if (folder != nullptr) return folder;
  return data_folder(literature ? "literature" : "verification");
}

}  // namespace

VerificationTable read_verification_table(const std::string& path) {
  const Value document = cases::parse_document(io::read_file(path), path);
  const Keys keys(document, "the file",
                  {"title", "text", "note", "order_in", "repeat", "case", "levels", "methods",
                   "set", "parameters", "measure", "run", "column", "bound"});
  VerificationTable table;
  table.file = path;
  table.name = fs::path(path).stem().string();
  table.title = keys.text("title");
  table.text = keys.text("text");
  table.note = keys.text("note", "");
  const std::string order_in = keys.text("order_in", "spacing");
  if (order_in != "spacing" && order_in != "steps")
    fail(keys.at("order_in").where, "order_in must be \"spacing\" or \"steps\"");
  table.order_in_steps = order_in == "steps";
  table.repeat = keys.count("repeat", 1);
  if (table.repeat < 1) fail(keys.at("repeat").where, "repeat must be 1 or more");
  table.parameters = read_parameters(keys.find("parameters"));
  for (const Value& value : keys.list("measure"))
    table.measures.push_back(read_measure(value, table.parameters));
  std::vector<std::string> names, titles;
  for (const Value& value : keys.list("run")) {
    table.runs.push_back(read_run(value, keys));
    names.push_back(table.runs.back().name);
  }
  for (const Value& value : keys.list("column")) {
    table.columns.push_back(read_column(value, table));
    titles.push_back(table.columns.back().title);
  }
  for (const Value& value : keys.list("bound"))
    table.bounds.push_back(read_bound(value, table));
  if (table.runs.empty() || table.columns.empty())
    fail(document.where, "a table needs a [[run]] and a [[column]]");
  check_distinct(document.where, names);
  check_distinct(document.where, titles);
  return table;
}

std::vector<std::string> shipped_verification_tables(VerificationSet set) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_of(set), error)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string find_verification_table(const std::string& name) {
  std::error_code error;
  if (fs::is_regular_file(name, error)) return name;
  std::vector<std::string> known;
  for (const VerificationSet set : {VerificationSet::verification, VerificationSet::literature}) {
    const fs::path shipped = fs::path(folder_of(set)) / (name + ".toml");
    if (name.find('/') == std::string::npos && fs::is_regular_file(shipped, error))
      return shipped.string();
    for (const std::string& other : shipped_verification_tables(set))
      known.push_back(other);
  }
  throw base::InputError("no verification table '" + name + "'" + base::suggestion(name, known));
}

}  // namespace diptych::harness
