#include "common/cases/sections/sections.hpp"
#include "common/scheme/option_menus.hpp"
#include "common/time/integrator.hpp"

namespace diptych::cases {

SectionEntry time_section() {
  const auto keys =
      SectionKeys<TimeCase>("time")
          .key("end", &TimeCase::end,
               {"s", above(0), "Final time; the run starts at t = 0.", "\"1.25*2*pi/omega\"",
                "required"})
          .key(
              "integrator", &TimeCase::integrator,
              one_of(time::integrator_menu().names(),
                     "Time integrator. leapfrog: one evaluation a step, second order but for its "
                     "dissipation, which lags half a step; ssp-rk3: third order, branches by GEXP, "
                     "takes energy from short waves; ssp-rk43: the same with four stages, the "
                     "cheapest of third order with limiters of shocks and strong dissipation.",
                     "\"ssp-rk3\""))
          .key("cfl", &TimeCase::cfl,
               optional({"-", Range{0, 10, false, true},
                         "Time step as a fraction of the bound of the graph.", "0.5",
                         "optional; found from the graph and the integrator"}))
          .key("speeds", &TimeCase::speeds,
               one_of(scheme::speeds_menu().names(),
                      "Wave speeds of the time step: of the current state pair by pair, the "
                      "largest of the current state for all pairs (a little smaller step), or of "
                      "the undeformed body (a stiffening body can then exceed the stable step).",
                      "\"bound\""))
          .key("max_steps", &TimeCase::max_steps,
               {"-", at_least(0), "The run stops after so many steps; 0 sets no limit.", "1000"})
          .key(
              "max_retries", &TimeCase::max_retries,
              {"-", between(0, 40),
               "A step that ends with J <= 0 or a value that is not finite is made again from its "
               "beginning with half the size, so many times in a row; then the run is stopped "
               "(code 3) and the state before the step is kept. So is one of the first 20 steps of "
               "a body that holds energy, at the start or where a load jumps, that opens the "
               "energy "
               "budget by more than a 40th of guards.energy_residual (SSP-RK), or whose energy "
               "swings "
               "by more than half of it (leapfrog); with the last retry it stands. The steps "
               "after grow back by 1.2 each. 0: no retry, and no state kept, which saves a copy "
               "(diptych cost).",
               "0"})
          .key("checkpoint_every", &TimeCase::checkpoint_every,
               {"-", at_least(0),
                "diptych run keeps the whole state of a run on the disk after so many steps and at "
                "its end: --restart latest goes on from there. The two latest stay. 0: only where "
                "the run is interrupted.",
                "10000"})
          .key("checkpoint_seconds", &TimeCase::checkpoint_seconds,
               {"s", at_least(0),
                "The same after so many seconds of the clock since the last one, with the step "
                "that ends then. 0: never.",
                "1800"})
          .key("checkpoint_interval", &TimeCase::checkpoint_interval,
               {"s", at_least(0),
                "The same with the first step that ends at or after each multiple of this time of "
                "the scene. 0: never.",
                "0.1"});
  return plain_section({"time", false, "How long and how."}, keys, &Case::time);
}

}  // namespace diptych::cases
