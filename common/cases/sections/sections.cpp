#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

const std::vector<SectionEntry>& section_entries() {
#define DIPTYCH_SECTION(name) name##_section(),
  static const std::vector<SectionEntry> entries{
#include "common/cases/sections/sections.def"
  };
#undef DIPTYCH_SECTION
  return entries;
}

const std::vector<Key>& keys() {
  static const auto all = [] {
    std::vector<Key> list;
    for (const SectionEntry& entry : section_entries())
      list.insert(list.end(), entry.keys.begin(), entry.keys.end());
    return list;
  }();
  return all;
}

const std::vector<Section>& sections() {
  static const auto all = [] {
    std::vector<Section> list;
    for (const SectionEntry& entry : section_entries()) {
      if (!entry.section.path.empty()) list.push_back(entry.section);
    }
    return list;
  }();
  return all;
}

}  // namespace diptych::cases
