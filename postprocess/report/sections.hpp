#pragma once
/// The parts of the page, each a piece of HTML; empty where the study has nothing to say there.

#include "postprocess/report/study_report.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace diptych::report {

std::string header_section(const StudyReport& study);
std::string breakdowns_section(const StudyReport& study);
std::string verdict_section(const StudyReport& study);
std::string panels_section(
    const StudyReport& study);  ///< the two methods side by side, finest level
std::string shapes_section(const StudyReport& study);
std::string probes_section(const StudyReport& study);
std::string cost_section(const StudyReport& study);
std::string convergence_section(const StudyReport& study);
std::string quantities_section(const StudyReport& study);
std::string energy_section(const StudyReport& study);
std::string runs_section(const StudyReport& study);
std::string provenance_section(const StudyReport& study);

/// Every how many-th output time the curves show; more than 1000 no screen tells apart.
size_t row_stride(size_t n_rows);

/// A sentence on that where it leaves some out.
std::string stride_note(const StudyReport& study);

/// Energies and momenta that the exact solution gives besides the probes.
std::vector<io::HistoryColumn> exact_others(const StudyReport& study);

/// Finest runs of the methods that have the study's probes.
std::vector<io::RunSummary> probed_runs(const StudyReport& study);

}  // namespace diptych::report
