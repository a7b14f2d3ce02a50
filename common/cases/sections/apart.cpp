#include "common/base/text.hpp"
#include "common/cases/sections/sections.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::cases {

namespace {

SectionKeys<ApartCase> apart_keys() {
  return SectionKeys<ApartCase>("apart")
      .key("quantity", &ApartCase::quantity,
           {"-", any,
            "The name of a probe, an energy (kinetic energy, strain energy, viscous dissipation, "
            "numerical dissipation, external work, projection work), or min jacobian.",
            "\"min jacobian\"", "required"})
      .key("because", &ApartCase::because,
           {"-", any, "The cause, with the figures that were measured of it.",
            "\"no limit: 0.888, 0.859, 0.818 on levels 0 to 2\"", "required"});
}

/// What two methods may differ on.
std::vector<std::string> quantities_of(const Case& setup) {
  std::vector<std::string> names{"kinetic energy",        "strain energy", "viscous dissipation",
                                 "numerical dissipation", "external work", "projection work",
                                 "min jacobian"};
  for (const ProbeCase& probe : setup.probes)
    names.push_back(probe.name);
  return names;
}

}  // namespace

SectionEntry apart_section() {
  const auto keys = apart_keys();
  return {{"apart", true,
           "Why the methods differ by more than the sum of their error bars on a quantity. Every "
           "verdict that they are apart is told with it; the regression asks for it where one that "
           "was recorded has none, and no case that is shipped may lack it."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            for (const SectionValues& entry : reading.entries("apart")) {
              const ApartCase apart = keys.read(entry);
              const std::vector<std::string> names = quantities_of(setup);
              if (std::find(names.begin(), names.end(), apart.quantity) == names.end()) {
                entry.fail("quantity", fmt::format("= '{}' is no quantity of both methods{}",
                                                   shown(apart.quantity),
                                                   base::suggestion(apart.quantity, names)));
              }
              const bool is_second =
                  std::any_of(setup.apart.begin(), setup.apart.end(),
                              [&](const ApartCase& one) { return one.quantity == apart.quantity; });
              if (is_second) {
                entry.fail("quantity", fmt::format("= '{}' has an [[apart]] already; write one "
                                                   "cause of both",
                                                   shown(apart.quantity)));
              }
              setup.apart.push_back(apart);
            }
          }};
}

}  // namespace diptych::cases
