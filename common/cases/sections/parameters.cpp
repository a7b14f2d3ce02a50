#include "common/base/error.hpp"
#include "common/cases/sections/sections.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::cases {

namespace {

void read_parameters(Reading& reading) {
  const Value* table = reading.table("parameters");
  if (table == nullptr) return;
  for (const Member& member : table->members) {
    check_new_name(member.name, {}, member.where);
    // The vocabulary holds the parameters above only, so none can use itself or a later one. A
    // table of one: looking each up among all would take their number squared.
    Value one;
    one.where = table->where;
    one.members = {member};
    const SectionValues section(reading, &one, "parameters");
    const double value = section.number(member.name);
    reading.vocabulary.parameters[member.name] = value;
  }
}

}  // namespace

void check_new_name(const std::string& name,
                    const std::vector<std::string>& taken,
                    const functions::SourcePlace& where) {
  const auto refuse = [&](const char* reason) {
    throw base::InputError(fmt::format("{}'{}' {}", functions::prefix(where), shown(name), reason));
  };
  const auto has = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (!functions::is_name(name)) refuse("is no name; use letters, digits and '_', a letter first");
  if (has(functions::reserved_names()))
    refuse("already has a meaning in expressions; take another name");
  if (has(taken)) refuse("is defined twice; take another name");
}

SectionEntry parameters_section() {
  const auto keys =
      SectionKeys<Case>("parameters")
          .key("*", KeyType::number,
               {"-", any, "A number that expressions may use by its name.", "17e6", "as you like"});
  return {{"parameters", false,
           "Numbers with names, in order: each may use the ones before it, all later keys may use "
           "them in expressions."},
          keys.keys(),
          [](Reading& reading, Case&) { read_parameters(reading); }};
}

}  // namespace diptych::cases
