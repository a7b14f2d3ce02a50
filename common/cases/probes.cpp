#include "common/cases/probes.hpp"

#include "common/base/error.hpp"

#include <fmt/format.h>

namespace diptych::cases {

namespace {

/// Names and units make up the headers of columns, "name [unit]".
std::string label(const SectionValues& section, const char* key, const char* forbidden) {
  const std::string text = section.text(key);
  if (!text.empty() && text.find_first_of(forbidden) == std::string::npos) return text;
  section.fail(key, text.empty() ? std::string("is empty; give it a text for the column's header")
                                 : fmt::format("= '{}' holds one of {} and cannot be part of the "
                                               "header of a column",
                                               text, forbidden));
}

ProbeCase read_probe(const SectionValues& section, functions::Vocabulary vocabulary) {
  ProbeCase probe;
  probe.where = section.where();
  probe.name = label(section, "name", "[]/");
  probe.unit = label(section, "unit", "[]");
  probe.kind = section.menu_name("kind");
  const auto refuse = [&](const char* name) {
    section.refuse(name, fmt::format("has no effect on kind = \"{}\"; remove it", probe.kind));
  };
  if (probe.kind == "reaction") {
    refuse("quantity");
    probe.direction = section.direction("direction");
  } else {
    refuse("direction");
    probe.fields = std::make_shared<ProbeFields>();
    probe.fields->check_names(vocabulary, probe.where);
    vocabulary.time_functions.push_back(probe.fields);
    probe.quantity = section.scalar_field("quantity", vocabulary);
  }
  if (probe.kind == "point") {
    refuse("group");
    probe.at = section.required_vector("at");
  } else {
    refuse("at");
    if (probe.kind == "reaction" || section.has("group")) probe.groups = section.groups("group");
  }
  probe.every_step = section.flag("every_step");
  probe.oscillation = section.flag("oscillation");
  return probe;
}

}  // namespace

std::vector<ProbeCase> read_probes(const std::vector<SectionValues>& entries,
                                   const functions::Vocabulary& vocabulary) {
  std::vector<ProbeCase> probes;
  for (const SectionValues& entry : entries) {
    ProbeCase probe = read_probe(entry, vocabulary);
    for (const ProbeCase& other : probes) {
      if (other.name != probe.name) continue;
      throw base::InputError(fmt::format("{}a probe is already called '{}' (line {}); rename one",
                                         functions::prefix(probe.where), probe.name,
                                         other.where.line));
    }
    probes.push_back(std::move(probe));
  }
  return probes;
}

}  // namespace diptych::cases
