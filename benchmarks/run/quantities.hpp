#pragma once
/// What the probes of a run come to: final values, extremes, oscillations.

#include "benchmarks/run/run_case.hpp"

namespace diptych::harness {

/// @param result  with its history and steps
std::vector<io::QuantitySummary> quantities_of(const std::vector<cases::ProbeCase>& probes,
                                               const RunResult& result);

/// Headers of the probes' columns. @param stepped  only those with every_step
std::vector<std::string> probe_columns(const cases::Case& setup, bool stepped);

/// "tip deflection: 1.25 m at the end, -0.1 to 1.3; period 0.65 s, ..."
std::string quantity_line(const io::QuantitySummary& quantity);

}  // namespace diptych::harness
