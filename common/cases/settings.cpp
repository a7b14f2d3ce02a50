#include "common/cases/settings.hpp"

#include "common/cases/document.hpp"
#include "common/cases/values.hpp"

#include <fmt/format.h>
#include <set>
#include <sstream>

namespace diptych::cases {

namespace {

using Settings = std::map<std::string, std::string>;

bool may_change(const std::string& path) {
  static const std::set<std::string> keys{"time.end", "time.max_steps", "time.checkpoint_every",
                                          "time.checkpoint_seconds", "time.checkpoint_interval"};
  return keys.count(path) > 0 || path.rfind("output.", 0) == 0 || path.rfind("variant.", 0) == 0;
}

/// On one line.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text)
    result += c == '\n' ? std::string("\\n") : std::string(1, c);
  return result + '"';
}

void add(const std::string& path, const Value& value, Settings& settings) {
  switch (value.kind) {
    case Value::Kind::table:
      for (const Member& member : value.members)
        add(path.empty() ? member.name : path + "." + member.name, member.value, settings);
      return;
    case Value::Kind::list:
      for (size_t k = 0; k < value.elements.size(); ++k)
        add(fmt::format("{}.{}", path, k), value.elements[k], settings);
      return;
    case Value::Kind::flag:
      settings[path] = value.flag ? "true" : "false";
      return;
    case Value::Kind::integer:
      settings[path] = fmt::format("{}", value.integer);
      return;
    case Value::Kind::real:
      settings[path] = fmt::format("{}", value.real);
      return;
    case Value::Kind::text:
      settings[path] = quoted(value.text);
      return;
    case Value::Kind::date:
      settings[path] = "a date";
      return;
  }
}

Settings settings_in(const std::string& text) {
  Settings settings;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const size_t sign = line.find(" = ");
    if (sign != line.npos) settings[line.substr(0, sign)] = line.substr(sign + 3);
  }
  return settings;
}

}  // namespace

std::map<std::string, std::string> lasting_settings(const Case& setup) {
  Value document = parse_document(setup.text, setup.file);
  apply_overrides(document, setup.overrides);
  Settings settings;
  add("", document, settings);
  std::erase_if(settings, [](const auto& setting) { return may_change(setting.first); });
  return settings;
}

std::string settings_text(const std::map<std::string, std::string>& settings) {
  std::string text;
  for (const auto& [path, value] : settings)
    text += path + " = " + value + "\n";
  return text;
}

std::string changed_setting(const std::string& before, const std::string& now) {
  const Settings old = settings_in(before), given = settings_in(now);
  for (const auto& [path, value] : old) {
    const auto found = given.find(path);
    if (found == given.end()) return fmt::format("{} was {}, is not given now", path, value);
    if (found->second != value) return fmt::format("{} was {}, is {}", path, value, found->second);
  }
  for (const auto& [path, value] : given) {
    if (old.count(path) == 0) return fmt::format("{} was not given, is {}", path, value);
  }
  return "";
}

}  // namespace diptych::cases
