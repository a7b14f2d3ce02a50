#include "common/base/error.hpp"
#include "common/cases/functions/function_type.hpp"
#include "common/cases/sections/sections.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::cases {

namespace {

constexpr const char* family = "functions.*";

/// [functions.NAME]: the keys of other types are errors.
Function read_function(const std::string& name,
                       const SectionValues& section,
                       const std::vector<Key>& keys) {
  const std::string type = section.menu_name("type");
  const FunctionType& entry = function_menu().at(type);
  for (const Key& key : keys) {
    const std::string last = key.path.substr(std::string(family).size() + 1);
    const bool known = std::find(entry.names.begin(), entry.names.end(), last) != entry.names.end();
    if (!known && last != "type")
      section.refuse(last, "is no key of type = \"" + type + "\"; remove it");
  }
  return entry.read(name, section);
}

void read_functions(Reading& reading, const std::vector<Key>& keys) {
  const Value* table = reading.table("functions");
  if (table == nullptr) return;
  std::vector<std::string> taken;
  for (const auto& [name, value] : reading.vocabulary.parameters)
    taken.push_back(name);
  for (const Member& member : table->members) {
    const SectionValues section(reading, &member.value, "functions." + member.name);
    check_new_name(member.name, taken, member.where);
    Function function;
    try {
      function = read_function(member.name, section, keys);
    } catch (const base::InputError& error) {
      const std::string message = error.what();
      if (message.rfind("functions.", 0) != 0) throw;
      throw base::InputError(functions::prefix(member.where) + message);
    }
    for (const std::string& name : function->names()) {
      check_new_name(name, taken, member.where);
      taken.push_back(name);
    }
    reading.vocabulary.time_functions.push_back(function);
  }
}

}  // namespace

SectionEntry functions_section() {
  std::string meaning =
      "A function of time, or of place and time, that later expressions may use under the name of "
      "its section, here NAME.";
  std::vector<Key> keys =
      SectionKeys<Case>(family)
          .key("type", KeyType::name,
               one_of(function_menu().names(), "Kind of function.", "\"zener_mode\"", "required"))
          .keys();
  for (const std::string& name : function_menu().names()) {
    const FunctionType& type = function_menu().at(name);
    if (!type.meaning.empty()) meaning += " " + type.meaning;
    keys.insert(keys.end(), type.keys.begin(), type.keys.end());
  }
  return {{family, false, meaning}, keys, [keys](Reading& reading, Case&) {
            read_functions(reading, keys);
          }};
}

}  // namespace diptych::cases
