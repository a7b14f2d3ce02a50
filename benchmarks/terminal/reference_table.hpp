#pragma once
/// Runs against the values from elsewhere that their case names ([[reference]]), as text for a
/// terminal of 100 columns. Test: tests/report/tables_test.cpp

#include "common/io/run_record.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// "met", "NOT met, 260 times", or "none stated".
std::string uncertainty_verdict(const io::ReferenceSummary& reference);

/// A line for each reference and run: largest distance, when, root mean square, distance at the
/// last instant, the stated uncertainty and whether the run is within it. Empty where no run has a
/// reference.
std::string reference_table(const std::vector<io::RunSummary>& runs);

}  // namespace diptych::harness
