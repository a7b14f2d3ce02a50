#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

SectionEntry initial_section() {
  const auto keys =
      SectionKeys<InitialCase>("initial")
          .key("displacement", &InitialCase::displacement,
               {"m", any,
                "Displacement at t = 0; F is its discrete gradient unless deformation_gradient is "
                "given.",
                "[\"1e-3*x\", 0, 0]"})
          .key("velocity", &InitialCase::velocity,
               {"m/s", any, "Velocity at t = 0.", "[\"10*z/6\", 0, 0]"})
          .key("deformation_gradient", &InitialCase::deformation_gradient,
               {"-", any,
                "F at t = 0, by rows; in 2-D two rows of two, or three of three. It must be that "
                "of the displacement, to 1e-3.",
                "[[\"1 + 1e-3*cos(pi*x)\", 0, 0], [0, 1, 0], [0, 0, 1]]"})
          .choice("internal", &InitialCase::relaxed, {{"virgin", false}, {"relaxed", true}},
                  {"-", any,
                   "Branches start at C_v = G_v = I (virgin) or at equilibrium with F (relaxed).",
                   "\"relaxed\""});
  return plain_section({"initial", false, "The state at t = 0."}, keys, &Case::initial);
}

}  // namespace diptych::cases
