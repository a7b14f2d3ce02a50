#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

SectionEntry exact_section() {
  const auto keys =
      SectionKeys<ExactCase>("exact")
          .key("displacement", &ExactCase::displacement,
               {"m", any, "Exact displacement.", "[\"q*sin(pi*y/2)\", 0, 0]"})
          .key("velocity", &ExactCase::velocity,
               {"m/s", any, "Exact velocity.", "[\"q_dot*sin(pi*y/2)\", 0, 0]"})
          .key("deformation_gradient", &ExactCase::deformation_gradient,
               {"-", any, "Exact F, by rows; in 2-D two rows of two, or three of three.",
                "[[1, \"q*pi/2*cos(pi*y/2)\", 0], [0, 1, 0], [0, 0, 1]]"})
          .key("stress", KeyType::tensor_field,
               {"Pa", any,
                "Exact first Piola-Kirchhoff stress, three rows of three (P_33 in 2-D too).",
                "[[0, \"mu*q*pi/2*cos(pi*y/2)\", 0], [\"mu*q*pi/2*cos(pi*y/2)\", 0, 0], [0, 0, 0]]",
                "optional"});
  return {{"exact", false,
           "The exact solution; errors are measured against it. Fields that are missing are "
           "derived from the displacement, stresses from the deformation gradient where there is "
           "none."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            const SectionValues section = reading.section("exact");
            setup.exact = keys.read(section);
            if (section.has("stress")) setup.exact.stress = section.tensor_field("stress", false);
          }};
}

}  // namespace diptych::cases
