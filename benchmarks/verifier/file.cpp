/// Reads the file of a verification table.

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/data_folder.hpp"
#include "benchmarks/run/toml_table.hpp"
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
using Keys = TomlTable;

std::map<std::string, double> read_parameters(const Value* section) {
  std::map<std::string, double> parameters;
  if (section == nullptr) return parameters;
  for (const cases::Member& member : section->members) {
    const Value& value = member.value;
    if (!functions::is_name(member.name))
      toml_fail(member.where, "'" + member.name + "' is no name");
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
    toml_fail(keys.at("name").where, "a name has letters, digits and _");
  if (!contains(reductions(), measure.reduce)) {
    toml_fail(keys.at("reduce").where, "unknown reduction '" + measure.reduce + "'" +
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
  if (section.kind != Value::Kind::table) toml_fail(section.where, "vary must be a table");
  for (const cases::Member& member : section.members) {
    if (member.value.kind != Value::Kind::list || member.value.elements.empty())
      toml_fail(member.value.where, "a varied key needs a list of values");
    std::vector<std::string> values;
    for (const Value& value : member.value.elements)
      values.push_back(assigned(value));
    entry.vary.emplace_back(member.name, values);
    if (entry.levels.size() == 1) entry.levels.assign(values.size(), entry.levels[0]);
    if (values.size() != entry.levels.size()) {
      toml_fail(member.value.where, fmt::format("{} values for {} levels; give one for each",
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
  if (entry.levels.empty()) toml_fail(value.where, "[[run]] lacks 'levels'");
  if (entry.methods.empty()) entry.methods = method_menu().names();
  for (const std::string& method : entry.methods) {
    if (!contains(method_menu().names(), method))
      toml_fail(value.where, "unknown method '" + method + "'" +
                                 base::suggestion(method, method_menu().names()));
  }
  entry.set = file.texts("set");
  for (const std::string& assignment : keys.texts("set"))
    entry.set.push_back(assignment);
  if (const Value* vary = keys.find("vary")) read_vary(*vary, entry);
  try {
    find_case(entry.case_name);
  } catch (const base::InputError& error) {
    toml_fail(value.where, error.what());
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
    toml_fail(keys.at("literature").where,
              "literature stands beside an extrapolated value; add estimate = true");
  }
  std::vector<std::string> names;
  for (const VerificationRun& entry : table.runs)
    names.push_back(entry.name);
  if (!column.ratio_to.empty() && !contains(names, column.ratio_to)) {
    toml_fail(keys.at("ratio_to").where,
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
      toml_fail(keys.at(key).where,
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
    toml_fail(value.where, "[[bound]] needs one of least_order, most, least, most_spread");
  return bound;
}

void check_distinct(const functions::SourcePlace& where, const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(name).second)
      toml_fail(where, "'" + name + "' stands twice; take another name");
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
    toml_fail(keys.at("order_in").where, "order_in must be \"spacing\" or \"steps\"");
  table.order_in_steps = order_in == "steps";
  table.repeat = keys.count("repeat", 1);
  if (table.repeat < 1) toml_fail(keys.at("repeat").where, "repeat must be 1 or more");
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
    toml_fail(document.where, "a table needs a [[run]] and a [[column]]");
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
