#pragma once
/// How far a run is from the values from elsewhere that its case names ([[reference]]). Both are
/// compared at the times of whichever has fewer of them in the span that they share, the other one
/// along straight lines between its own times. Test: tests/common/run/references_test.cpp

#include "common/cases/case.hpp"
#include "common/io/run_record.hpp"

#include <map>
#include <string>
#include <vector>

namespace diptych::run {

/// An override by which the case is no longer the scene that its references are of (material,
/// parameters, initial state, boundary, load, body), or an empty text.
std::string changed_scene(const std::vector<std::string>& overrides);

/// What references are called in summaries, in the order of the case: "tip (2)" where it is the
/// second one of that probe.
std::vector<std::string> reference_names(const cases::Case& setup);

/// Name: times of its values  [s].
std::map<std::string, std::vector<double>> reference_times(const cases::Case& setup);

/// In the order of the case; without those of which the run has no time, and none at all where the
/// scene was changed by an override. A probe of every step is taken from `steps`.
std::vector<io::ReferenceSummary> references_of(const cases::Case& setup,
                                                const std::vector<io::HistoryRow>& history,
                                                const std::vector<io::StepRow>& steps);

}  // namespace diptych::run
