#pragma once
/// Runs of a study that broke down: who, when, where, why, on the terminal and for the report.
/// Test: tests/command_line/breakdown_test.cpp

#include "common/io/run_record.hpp"
#include "postprocess/report/study_report.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// @pre the run has the status "breakdown"
report::Breakdown breakdown_of(const io::RunSummary& run);

/// "fvm level 0: ..." @pre the same
std::string breakdown_message(const io::RunSummary& run);

/// A table and, below it, what each run said; empty where there is none.
std::string breakdown_table(const std::vector<report::Breakdown>& breakdowns);

/// 130 after an interrupt, else 3 after a breakdown or an unsound end, else 5 where a run does not
/// hold what its case asks, else 0, with lines on the standard error stream. @param to_go_on  what
/// the user finds and does after an interrupt
int exit_code_of_study(const std::vector<report::Breakdown>& breakdowns,
                       const std::vector<io::RunSummary>& runs,
                       const std::string& to_go_on);

}  // namespace diptych::harness
