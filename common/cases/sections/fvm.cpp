#include "common/cases/sections/sections.hpp"

#include <fmt/format.h>

namespace diptych::cases {

namespace {

void check(const SectionValues& section, const FvmCase& fvm) {
  if (fvm.stencil != "sbp" && fvm.stencil != "auto") {
    section.refuse("order",
                   fmt::format("has no effect on stencil = \"{}\"; it is for sbp", fvm.stencil));
  }
  if (fvm.order % 2 != 0) {
    section.fail("order",
                 fmt::format("= {} is not the order of an operator; use 2, 4 or 6", fvm.order));
  }
}

}  // namespace

SectionEntry fvm_section() {
  const auto keys =
      SectionKeys<FvmCase>("fvm")
          .key(
              "stencil", &FvmCase::stencil,
              as(KeyType::name,
                 {"-", any,
                  "Pair areas by nodal quadrature (edge), by 2 int N_a grad N_b dV "
                  "(integral), or from operators that sum by parts (sbp): along the "
                  "lines of nodes of boxes of hexahedra or quadrilaterals and of smooth curved "
                  "blocks of them, glued where they meet (transfinite meshes of Gmsh), elsewhere "
                  "over two rings of cells. auto: sbp where the mesh "
                  "takes it, on boxes with a line of three nodes or more and boundary groups that "
                  "cover whole sides or end far from their edges, but with a face correction and, "
                  "off boxes, where a scene presses hard (scheme.volumes), curved lines have three "
                  "nodes along several directions, or, with jumps that are not symmetric "
                  "(scheme.reconstruction), six; else edge. On curved blocks auto takes cells, not "
                  "lines, where lame >= 99 shear_modulus and where lines of fewer than eight nodes "
                  "have uneven cells (neighbours differ by more than a tenth), if they take it.",
                  "\"sbp\""}))
          .key("order", &FvmCase::order,
               {"-", between(2, 6),
                "With stencil = \"sbp\" or \"auto\" on a box or blocks, order of the derivatives "
                "inside: 2 "
                "(the edge stencil), 4 or 6; half of it at boundaries. On lines of fewer than 8 "
                "(4) or 12 nodes (6) it falls to the next, on those of 3 to 7 to pairs that are "
                "exact for quadratics. Curved blocks take at most 4. With reconstruction = "
                "\"linear\" 6 takes scheme.limiter = "
                "\"sign-preserving\".",
                "6"});
  return {{"fvm", false, "What only the finite volumes need."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            const SectionValues section = reading.section("fvm");
            setup.fvm = keys.read(section);
            check(section, setup.fvm);
          }};
}

}  // namespace diptych::cases
