#pragma once
/// Runs against the values from elsewhere that their case names ([[reference]]), as text for a
/// terminal of 100 columns. Test: tests/report/tables_test.cpp

#include "common/io/run_record.hpp"

#include <map>
#include <string>
#include <vector>

namespace diptych::harness {

/// Of references by their names: times of all their values  [s].
using ReferenceTimes = std::map<std::string, std::vector<double>>;

/// "met", "met at 1 of 4 times" where the run ended before the others, "NOT met, 260 times", or
/// "none stated".
/// @param end  of the run  [s]
std::string uncertainty_verdict(const io::ReferenceSummary& reference,
                                double end = 0,
                                const ReferenceTimes& times = {});

/// A line for each reference and run: largest distance, when, root mean square, distance at the
/// last instant, the stated uncertainty and whether the run is within it. Empty where no run has a
/// reference.
std::string reference_table(const std::vector<io::RunSummary>& runs,
                            const ReferenceTimes& times = {});

}  // namespace diptych::harness
