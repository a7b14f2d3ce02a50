#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

SectionEntry guards_section() {
  const auto keys =
      SectionKeys<GuardsCase>("guards")
          .key("energy_residual", &GuardsCase::energy_residual,
               {"-", above(0),
                "The run is stopped (code 3) where, at an output instant, the energy that the "
                "budget does not account for is more than this share of the largest energy so "
                "far. Not judged in the first 20 steps of a body at rest. Needs "
                "scheme.energy_budget.",
                "0.02"})
          .key("inverted_cells", &GuardsCase::inverted_cells,
               one_of({"stop", "warn"},
                      "What happens where, at an output instant, cells of the deformed mesh are "
                      "inside out: the run is stopped (code 3), or goes on and warns at its end.",
                      "\"warn\""));
  return plain_section({"guards", false, "What stops a run that is no solution any more."}, keys,
                       &Case::guards);
}

}  // namespace diptych::cases
