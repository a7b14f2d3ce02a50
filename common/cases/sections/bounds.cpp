#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

SectionEntry bounds_section() {
  const auto keys = SectionKeys<BoundsCase>("bounds").key(
      "numerical_dissipation", &BoundsCase::numerical_dissipation,
      {"-", Range{0, 1, false, true},
       "The most that D_ab may have dissipated at the end, as a share of the largest "
       "energy so far (as guards.energy_residual).",
       "0.01"});
  return plain_section({"bounds", false,
                        "What the regression asks of both methods at the size of the baseline. "
                        "What was beyond its bound when the baseline was recorded is shown as not "
                        "met, with its figure, and must not grow."},
                       keys, &Case::bounds);
}

}  // namespace diptych::cases
