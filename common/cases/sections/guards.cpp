#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

SectionEntry guards_section() {
  const auto keys =
      SectionKeys<GuardsCase>("guards")
          .key(
              "energy_residual", &GuardsCase::energy_residual,
              {"-", above(0),
               "The run is stopped (code 3) where the energy that the budget does not account for, "
               "or that numerical dissipation has given to the body, is more than this share of "
               "the largest energy so far (in the frame of the centre of mass along directions in "
               "which nothing that stands still holds the body, so that flight, fall and supports "
               "that move do not count), at an output instant or "
               "50 steps after the last judgement. For what the budget "
               "does not account for the bound is 8/n^2 or 0.5/n, where these are larger, in step "
               "n < 50 "
               "after "
               "a state of rest, or, at most 0.5, after the energy has passed a 64th of what it "
               "is.",
               "0.02"})
          .key("numerical_dissipation", &GuardsCase::numerical_dissipation,
               optional({"-", Range{0, 1, false, true},
                         "The run is stopped (code 3) where numerical dissipation, and rigid walls "
                         "as they catch nodes, have taken more "
                         "than this share of the same energy, at the same steps but for "
                         "the first 20 after a state of rest and the first tenth of time.end (or "
                         "of time.max_steps), in "
                         "which loads may still bring what matters: what is left is no solution of "
                         "the equations. 1: no bound.",
                         "0.05",
                         "optional; 0.5, and no bound with a limiter of shocks (all but \"none\" "
                         "and \"sign-preserving\"): shocks dissipate"}))
          .key("involution", &GuardsCase::involution,
               {"-", above(0),
                "The run is stopped (code 3) where |H - cof F| or |J - det F| of a node is more "
                "than this, at the same steps.",
                "0.05"})
          .key(
              "angular_drift", &GuardsCase::angular_drift,
              {"-", above(0),
               "The run is stopped (code 3) where angular momentum differs by more than this "
               "from that of the start and of the moments of loads and supports, at the same steps "
               "but for the first 20 after a state of rest: as a share of the largest sum of "
               "|x||p| over the nodes so far, or, of a body that supports hold, of what it would "
               "have "
               "if it spun with the largest work of loads and supports so far, or of the time "
               "integral of that work, if one of these is larger. At a loss of this share of its "
               "angular momentum a body that spins has lost nearly twice the share of its energy "
               "of "
               "rotation.",
               "0.5"})
          .key("volumes_apart", &GuardsCase::volumes_apart,
               {"-", above(0),
                "The run is stopped (code 3) where volumes of cells or lines that carry the "
                "pressure (scheme.volumes) and J of the nodes differ, in the mean over the body, "
                "by more than this share of its volume, at the same steps: the deviatoric stress "
                "then belongs to another motion than the pressure.",
                "0.5"})
          .key("least_step", &GuardsCase::least_step,
               {"-", Range{0, 1, false, true},
                "The run is stopped (code 3) where the time step has become less than this share "
                "of the first one.",
                "1e-4"})
          .key("inverted_cells", &GuardsCase::inverted_cells,
               one_of({"stop", "warn"},
                      "What happens where cells of the deformed mesh turn inside out: the run is "
                      "stopped (code 3) with the body as it was before that step (they are looked "
                      "at every 48 steps, and the more often the sooner one would have no volume "
                      "left; with time.max_retries = 0 the step stays), "
                      "or goes on, warns, and has the status \"unsound\" at its end (code 3 too) "
                      "if cells are inside out at an output instant.",
                      "\"warn\""));
  return plain_section({"guards", false, "What stops a run that is no solution any more."}, keys,
                       &Case::guards);
}

}  // namespace diptych::cases
