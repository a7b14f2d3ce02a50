#pragma once
/// The parts of the page, each a piece of HTML; empty where the study has nothing to say there.

#include "postprocess/report/study_report.hpp"

#include <string>

namespace diptych::report {

std::string header_section(const StudyReport& study);
std::string verdict_section(const StudyReport& study);
std::string panels_section(
    const StudyReport& study);  ///< the two methods side by side, finest level
std::string cost_section(const StudyReport& study);
std::string convergence_section(const StudyReport& study);
std::string energy_section(const StudyReport& study);
std::string runs_section(const StudyReport& study);
std::string provenance_section(const StudyReport& study);

}  // namespace diptych::report
