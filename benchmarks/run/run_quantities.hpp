#pragma once
/// The numbers of a run that tables show, bounds are asked of and studies are drawn from, each
/// under one name. Test: tests/harness/judgement_test.cpp,
/// tests/harness/variant_quantities_test.cpp

#include "common/io/run_record.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// "tip displacement x, greatest" in m, "kinetic energy" in J, "steps".
struct RunQuantity {
  std::string name, unit;
  double value = 0;
};

/// "NAME, final", "NAME, least", "NAME, greatest", "NAME, period", "NAME, amplitude"; the last two
/// are NaN where it does not swing.
std::vector<RunQuantity> quantities_of_probe(const io::QuantitySummary& probe);

/// Energies at the end (of plane strain those of a slice one metre thick), energy residual, least
/// J, steps and nodes: what every run has, whatever its case.
std::vector<RunQuantity> common_quantities(const io::RunSummary& run);

}  // namespace diptych::harness
