#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

SectionEntry sph_section() {
  const auto keys =
      SectionKeys<SphCase>("sph")
          .key("kernel", &SphCase::kernel,
               as(KeyType::name, {"-", any, "Smoothing kernel.", "\"wendland-c2\""}))
          .key(
              "kappa", &SphCase::kappa,
              {"-", between(0.5, 4),
               "Smoothing length over particle spacing: h_a = kappa (Omega_a/theta_a)^(1/d), "
               "theta_a "
               "the part of the angle around the node that the body fills, 1 inside. 1.2 suits any "
               "nodes; 0.75, one spacing and its diagonals, is cheaper and errs less on regular "
               "lattices. Boxes of quadrilaterals and hexahedra take more than 0.708, with "
               "quintic-spline 0.5: corners need their diagonals; of triangles and tetrahedra 0.8 "
               "or more. Off boxes, and with gradient = corrected, supports are ellipsoids where "
               "cells are 1.1 times as long as wide or more in the mean over the body.",
               "0.75"})
          .key("closure", &SphCase::closure,
               {"-", any,
                "Repair of the pseudo-areas at the boundary so that they close: "
                "-1/2 sum_b (C_ab - C_ba) = A_a N_a.",
                "false"})
          .key(
              "gradient", &SphCase::gradient,
              as(KeyType::name,
                 {"-", any,
                  "Pair areas from the kernel's gradient corrected to first order (corrected), or "
                  "by its least change to operators that sum by parts (sbp), exact for quadratics "
                  "up to the boundary, with kappa above 1: on boxes of hexahedra or quadrilaterals "
                  "with three nodes a line or more, in spacings of each line, and on any nodes of "
                  "other bodies. auto: sbp where the nodes take it, on boxes with three "
                  "nodes a line or more, supports of at most four spacings and boundary groups "
                  "that cover whole sides or end far from their edges, but with a face correction "
                  "or scheme.volumes = \"cells\" and, off boxes, where a scene presses hard "
                  "(scheme.volumes); else corrected.",
                  "\"sbp\""}));
  return {
      {"sph", false, "What only SPH needs."}, keys.keys(), [keys](Reading& reading, Case& setup) {
        const SectionValues section = reading.section("sph");
        setup.sph = keys.read(section);
        if (setup.sph.gradient == "sbp" && !setup.sph.closure)
          section.refuse("closure", "has no effect on gradient = \"sbp\", which closes");
      }};
}

}  // namespace diptych::cases
