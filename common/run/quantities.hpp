#pragma once
/// What the probes of a run come to: final values, extremes, oscillations.

#include "common/cases/case.hpp"
#include "common/io/run_record.hpp"

#include <vector>

namespace diptych::run {

/// Of probes in the order of the case: of every step where they were evaluated then, else of the
/// output times.
std::vector<io::QuantitySummary> quantities_of(const std::vector<cases::ProbeCase>& probes,
                                               const std::vector<io::HistoryRow>& history,
                                               const std::vector<io::StepRow>& steps);

}  // namespace diptych::run
