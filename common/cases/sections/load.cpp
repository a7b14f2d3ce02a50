#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

SectionEntry load_section() {
  const auto keys = SectionKeys<Case>("load").key(
      "body_force", &Case::body_force,
      {"N/m^3", any, "Force per undeformed volume.", "[0, 0, \"-9.81*rho\"]"});
  return {{"load", false, "Loads on the whole body."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            setup.body_force = keys.read(reading.section("load")).body_force;
          }};
}

}  // namespace diptych::cases
