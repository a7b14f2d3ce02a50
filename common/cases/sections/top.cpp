#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

SectionEntry top_section() {
  const auto keys = SectionKeys<Case>("").key(
      "title", &Case::title,
      {"-", any, "One line that says what the case is.", "\"swinging cube, P mode\""});
  return {{"", false, ""}, keys.keys(), [keys](Reading& reading, Case& setup) {
            setup.title = keys.read(reading.section("")).title;
          }};
}

}  // namespace diptych::cases
