#include "benchmarks/run/run_quantities.hpp"

#include <limits>

namespace diptych::harness {

std::vector<RunQuantity> quantities_of_probe(const io::QuantitySummary& probe) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const bool swings = probe.n_periods > 0;
  return {{probe.name + ", final", probe.unit, probe.final_value},
          {probe.name + ", least", probe.unit, probe.least},
          {probe.name + ", greatest", probe.unit, probe.greatest},
          {probe.name + ", period", "s", swings ? probe.period : nothing},
          {probe.name + ", amplitude", probe.unit, swings ? probe.amplitude : nothing}};
}

std::vector<RunQuantity> common_quantities(const io::RunSummary& run) {
  return {{"kinetic energy", "J", run.energy.kinetic},
          {"strain energy", "J", run.energy.strain},
          {"external work", "J", run.energy.external_work},
          {"viscous dissipation", "J", run.energy.viscous_dissipation},
          {"numerical dissipation", "J", run.energy.numerical_dissipation},
          {"projection work", "J", run.energy.projection_work},
          {"energy residual", "-", run.energy.relative_residual},
          {"least J", "-", run.min_jacobian},
          {"steps", "-", static_cast<double>(run.steps)},
          {"nodes", "-", static_cast<double>(run.nodes)}};
}

}  // namespace diptych::harness
