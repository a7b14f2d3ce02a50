#pragma once
/// The sections of a case file. A section is a file of this folder with its keys and what they
/// mean together, and a line in sections.def.

#include "common/cases/case.hpp"
#include "common/cases/section_keys.hpp"

#include <functional>
#include <vector>

namespace diptych::cases {

struct SectionEntry {
  Section section;
  std::vector<Key> keys;
  /// Reads the section into the case.
  /// @throws base::InputError
  std::function<void(Reading& reading, Case& setup)> read;
};

/// A section whose keys go to a struct of the case, without rules of its own.
template <class Struct>
SectionEntry plain_section(const Section& section,
                           const SectionKeys<Struct>& keys,
                           Struct Case::*member) {
  return {section, keys.keys(), [=](Reading& reading, Case& setup) {
            setup.*member = keys.read(reading.section(section.path));
          }};
}

#define DIPTYCH_SECTION(name) SectionEntry name##_section();
#include "common/cases/sections/sections.def"
#undef DIPTYCH_SECTION

/// All sections, in the order in which they are read.
const std::vector<SectionEntry>& section_entries();

/// A name that the user gives to a number must be new and fit for expressions.
/// @throws base::InputError
void check_new_name(const std::string& name,
                    const std::vector<std::string>& taken,
                    const functions::SourcePlace& where);

}  // namespace diptych::cases
