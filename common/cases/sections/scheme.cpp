#include "common/cases/sections/sections.hpp"
#include "common/scheme/dissipation/limiters/limiter_menu.hpp"
#include "common/scheme/option_menus.hpp"

#include <fmt/format.h>

namespace diptych::cases {

namespace {

SectionKeys<SchemeCase> scheme_keys() {
  return SectionKeys<SchemeCase>("scheme")
      .key(
          "unknowns", &SchemeCase::unknowns,
          one_of(scheme::unknowns_menu().names(),
                 "Strain measures with evolution equations of their own; the others follow from F.",
                 "\"F\""))
      .key(
          "reconstruction", &SchemeCase::reconstruction,
          one_of(
              scheme::reconstruction_menu().names(),
              "Reconstruction of the velocities on both sides of a pair. linear: with the slopes "
              "dF/dt; objective: the same in a frame that spins with the pair, in which a deformed "
              "body that spins rigidly dissipates nothing; quartic: with slopes along the lines of "
              "nodes of a box, whose jumps are of fifth order where those of linear are of third; "
              "symmetric: linear, with the adjoint of the slopes, so that what a body dissipates "
              "is a sum of squares on any nodes. "
              "auto: quartic where operators sum by parts on a box, but for limiters of slopes; "
              "symmetric with those on other nodes and along curved lines, without a limiter or "
              "face correction; else linear.",
              "\"objective\""))
      .key("limiter", &SchemeCase::limiter,
           one_of(scheme::limiter_menu().names(),
                  "Limiter of the linear reconstruction. At fronts: venkatakrishnan, with "
                  "scheme.face_correction = \"1/6\".",
                  "\"venkatakrishnan\""))
      .key("impedance", &SchemeCase::impedance,
           one_of(scheme::impedance_menu().names(),
                  "Impedance of the dissipation: of the two wave speeds, or the exact matrix.",
                  "\"exact\""))
      .key("dissipation", &SchemeCase::dissipation,
           {"-", at_least(0), "Factor of the dissipation D_ab.", "0"})
      .key("face_correction", &SchemeCase::face_correction,
           {"-", between(0, 0.25),
            "Factor kappa_f of the face correction with its adjoint: 0 none, 1/6 fourth-order "
            "first derivatives on a lattice, 1/8 exact face values of quadratics.",
            "\"1/6\""})
      .key(
          "volumes", &SchemeCase::volumes,
          one_of(
              scheme::volumes_menu().names(),
              "What carries the bulk pressure: J of the nodes, or volumes that keep bodies under "
              "pressure whole: of deformed cells, or by derivatives along the lines of nodes of a "
              "box (lines: SPH that sums by parts). auto, where a follower pressure or a dead "
              "traction presses with more than 1.5 shear moduli (over the cells' length "
              "by width, on moved nodes) or a nearly incompressible body "
              "(bulk modulus above 2.5 shear moduli) is held on all sides: nodes for fvm on boxes "
              "of hexahedra, where they are as safe; lines where the operators have them; else "
              "cells, with operators of second order, but for fvm on hexahedra with distorted "
              "faces on "
              "the boundary. Elsewhere lines of nearly incompressible mooney-rivlin with a "
              "zeta_ratio of 0.25 and more for SPH on boxes; "
              "with operators of second order cells of nearly incompressible material, but for fvm "
              "on boxes, and "
              "of any off boxes, but for fvm with the edge stencil on other cells than triangles "
              "and tetrahedra, where cells are up to 1.5 times as long as wide and without the "
              "face correction; else nodes.",
              "\"cells\""))
      .key("cell_shear", &SchemeCase::cell_shear,
           {"-", between(0, 1),
            "Share of the shear modulus that gradients of cells carry instead of those of nodes, "
            "where their volumes carry the bulk pressure: what holds waves that nodes see badly. "
            "Coarse bodies of long cells bend the stiffer for it.",
            "0"})
      .key("hourglass", &SchemeCase::hourglass,
           {"-", between(0, 20),
            "Stiffness of the mesh's edges, in shear moduli, against displacements that gradients "
            "of nodes do not see (zero-energy modes), where operators sum by parts off boxes and "
            "the reconstruction is symmetric (notes 3.12). Zero in quadratic motions, of fourth "
            "order in others.",
            "0"})
      .key("precision", &SchemeCase::precision,
           one_of(scheme::precision_menu().names(),
                  "Precision of what the sweeps keep. mixed: pseudo-areas C_ab in single, half the "
                  "memory of irregular nodes, 1e-7 of error. single: the state and the sums over "
                  "pairs too; half the memory, some 1e-5 of error relative to the largest speed; "
                  "energies "
                  "of strains below 1.5e-3 are rounding, and not judged.",
                  "\"single\""))
      .key("angular_momentum_projection", &SchemeCase::angular_momentum_projection,
           {"-", any,
            "Correct the velocities of a free body after each step so that its angular momentum is "
            "conserved.",
            "true"});
}

void check(const SectionValues& section, const SchemeCase& scheme) {
  if (scheme.reconstruction == "none" && scheme.limiter != "none") {
    section.fail("limiter", fmt::format("= '{}' has no effect with reconstruction = \"none\"; use "
                                        "limiter = \"none\"",
                                        scheme.limiter));
  }
  if (scheme.reconstruction == "objective" &&
      (scheme.impedance == "exact" ||
       (scheme.limiter != "none" && scheme.limiter != "sign-preserving"))) {
    section.fail("reconstruction",
                 "= \"objective\" has the isotropic impedance, and the limiters none and "
                 "sign-preserving, alone; use these, or reconstruction = \"linear\"");
  }
  if (scheme.reconstruction == "symmetric" &&
      (scheme.limiter != "none" || scheme.face_correction != 0)) {
    section.fail("reconstruction",
                 "= \"symmetric\" has neither limiters nor the face correction; use limiter = "
                 "\"none\" and face_correction = 0, or reconstruction = \"linear\"");
  }
  if (scheme.volumes == "nodes" || scheme.volumes == "lines") {
    section.refuse("cell_shear", fmt::format("has no effect with volumes = \"{}\"; it is for cells",
                                             scheme.volumes));
  }
  if ((scheme.reconstruction != "auto" && scheme.reconstruction != "symmetric") ||
      scheme.limiter != "none" || scheme.face_correction != 0) {
    section.refuse(
        "hourglass",
        "goes with the symmetric reconstruction alone, which has neither limiters nor the "
        "face correction; use reconstruction = \"auto\" or \"symmetric\"");
  }
  if (scheme.precision == "single" && scheme.impedance == "exact") {
    section.fail("precision",
                 "= \"single\" has no exact impedance; use \"mixed\" or \"double\", or "
                 "impedance = \"isotropic\"");
  }
}

}  // namespace

SectionEntry scheme_section() {
  const auto keys = scheme_keys();
  return {{"scheme", false, "The scheme that both methods share."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            const SectionValues section = reading.section("scheme");
            setup.scheme = keys.read(section);
            check(section, setup.scheme);
          }};
}

}  // namespace diptych::cases
