/// Baselines of the regression as JSON: numbers with all their digits, one file for each case.

#include "benchmarks/regression/regress.hpp"
#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/data_folder.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <regex>

namespace diptych::harness {

namespace {

using Json = nlohmann::ordered_json;

Json finite(const std::string& name, double value) {
  if (!std::isfinite(value)) {
    throw base::InputError(
        fmt::format("{} is {}: what is no finite number cannot be a baseline", name, value));
  }
  return value;
}

Json figures_json(const std::string& where, const RegressFigures& figures) {
  Json json = Json::object();
  for (const auto& [name, figure] : figures)
    json[name] = {{"value", finite(where + ": " + name, figure.value)},
                  {"scale", finite(where + ": " + name + " (scale)", figure.scale)}};
  return json;
}

/// Each figure on one line, so that a change of it is one line of a difference.
std::string with_figures_in_line(const std::string& json) {
  static const std::regex figure(R"(\{\n *("value": [^\n]*)\n *("scale": [^\n]*)\n *\})");
  return std::regex_replace(json, figure, "{$1 $2}") + "\n";
}

/// Keys of an object as they are read; what was not asked for is an error.
class Reader {
 public:
  Reader(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json.is_object()) throw base::InputError(where_ + ": must be an object");
  }

  const Json& at(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end())
      throw base::InputError(fmt::format("{}: '{}' is missing", where_, key));
    return *found;
  }
  std::string text(const char* key) const {
    if (!at(key).is_string()) wrong(key, "a text");
    return at(key).get<std::string>();
  }
  double number(const char* key) const {
    if (!at(key).is_number()) wrong(key, "a finite number");
    return at(key).get<double>();
  }
  Reader object(const char* key) const { return {at(key), where_ + ": " + key}; }
  [[noreturn]] void wrong(const char* key, const char* what) const {
    throw base::InputError(fmt::format("{}: '{}' must be {}", where_, key, what));
  }
  bool has(const char* key) const { return json_.contains(key); }
  void only(std::initializer_list<const char*> known) const {
    for (const auto& item : json_.items()) {
      if (std::find(known.begin(), known.end(), item.key()) == known.end())
        throw base::InputError(fmt::format("{}: unknown key '{}'", where_, item.key()));
    }
  }
  const Json& json() const { return json_; }
  const std::string& where() const { return where_; }

 private:
  const Json& json_;
  std::string where_;
};

RegressFigures figures_from(const Reader& reader) {
  RegressFigures figures;
  for (const auto& item : reader.json().items()) {
    const Reader figure(item.value(), reader.where() + ": " + item.key());
    figure.only({"value", "scale"});
    figures[item.key()] = {figure.number("value"), figure.number("scale")};
    if (figures[item.key()].scale < 0) figure.wrong("scale", "0 or more");
  }
  return figures;
}

RegressBaseline baseline_from(const Reader& reader) {
  reader.only({"case", "reason", "commit", "date", "platform", "set", "levels", "one_level_because",
               "disagreement", "methods"});
  RegressBaseline b;
  b.case_name = reader.text("case");
  b.reason = reader.text("reason");
  if (b.reason.find_first_not_of(" \t\r\n") == std::string::npos)
    reader.wrong("reason", "the reason why it was recorded");
  b.commit = reader.text("commit");
  b.date = reader.text("date");
  const Reader platform = reader.object("platform");
  platform.only({"instruction_set", "compiler", "flags"});
  b.platform = {platform.text("instruction_set"), platform.text("compiler"),
                platform.text("flags")};
  if (!reader.at("set").is_array()) reader.wrong("set", "a list of \"key=value\"");
  for (const Json& entry : reader.at("set")) {
    if (!entry.is_string()) reader.wrong("set", "a list of \"key=value\"");
    b.set.push_back(entry.get<std::string>());
  }
  const double levels = reader.number("levels");
  if (levels != 1 && levels != 2) reader.wrong("levels", "1 or 2");
  b.levels = static_cast<int>(levels);
  b.one_level_because = reader.text("one_level_because");
  if (b.levels == 1 && b.one_level_because.empty())
    reader.wrong("one_level_because", "the reason why there is one level only");
  const Reader disagreement = reader.object("disagreement");
  for (const auto& item : disagreement.json().items())
    b.disagreement[item.key()] = disagreement.number(item.key().c_str());
  if (b.levels == 1 && !b.disagreement.empty())
    reader.wrong("disagreement", "empty where there is one level, which compares no methods");
  const Reader methods = reader.object("methods");
  const std::vector<std::string> known = method_menu().names();
  for (const auto& item : methods.json().items()) {
    if (std::find(known.begin(), known.end(), item.key()) == known.end()) {
      throw base::InputError(fmt::format("{}: '{}' is no method; known: {}", methods.where(),
                                         item.key(), base::joined(known)));
    }
    const Reader method(item.value(), methods.where() + ": " + item.key());
    method.only({"state", "canary", "errors", "quantities", "unmet"});
    b.methods[item.key()] = {method.text("state"),
                             figures_from(method.object("canary")),
                             figures_from(method.object("errors")),
                             figures_from(method.object("quantities")),
                             {}};
    if (!method.has("unmet")) continue;
    const Reader unmet = method.object("unmet");
    for (const auto& figure : unmet.json().items())
      b.methods[item.key()].unmet[figure.key()] = unmet.number(figure.key().c_str());
  }
  return b;
}

}  // namespace

std::string to_json(const RegressBaseline& b) {
  Json json = {{"case", b.case_name},
               {"reason", b.reason},
               {"commit", b.commit},
               {"date", b.date},
               {"platform",
                {{"instruction_set", b.platform.instruction_set},
                 {"compiler", b.platform.compiler},
                 {"flags", b.platform.flags}}},
               {"set", b.set},
               {"levels", b.levels},
               {"one_level_because", b.one_level_because}};
  json["disagreement"] = Json::object();
  for (const auto& [name, excess] : b.disagreement)
    json["disagreement"][name] = finite(b.case_name + ": disagreement of " + name, excess);
  json["methods"] = Json::object();
  for (const auto& [method, figures] : b.methods) {
    const std::string where = b.case_name + ": " + method;
    json["methods"][method] = {{"state", figures.state},
                               {"canary", figures_json(where, figures.canary)},
                               {"errors", figures_json(where, figures.errors)},
                               {"quantities", figures_json(where, figures.quantities)}};
    for (const auto& [name, excess] : figures.unmet)
      json["methods"][method]["unmet"][name] = finite(where + ": " + name, excess);
  }
  return with_figures_in_line(json.dump(1));
}

RegressBaseline baseline_from_json(const std::string& text, const std::string& path) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw base::InputError(path + ": the file is empty");
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {  // of a number beyond all doubles, too
    throw base::InputError(fmt::format("{}: no JSON: {}", path, error.what()));
  }
  return baseline_from(Reader(json, path));
}

std::string baselines_folder(const std::string& asked) {
  if (!asked.empty()) return asked;
  const char* folder = std::getenv("DIPTYCH_BASELINES");
  return folder != nullptr && *folder != '\0' ? folder : data_folder("baselines");
}

}  // namespace diptych::harness
