#pragma once
/// Runs of a study that broke down, or that their step limit ended: who, when, where, why, on the
/// terminal and for the report.
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

/// Those that ended at time.max_steps, before the end of their case.
std::vector<io::RunSummary> cut_short(const std::vector<io::RunSummary>& runs);

/// "fvm level 0 ended at its step limit (time.max_steps): step 60, t = 0.012 s".
std::string cut_short_message(const io::RunSummary& run);

/// A line for each that was cut short; empty where none was.
/// @param left_out  of what the command compares: values at the ends of runs
std::string cut_short_table(const std::vector<io::RunSummary>& runs, bool left_out);

/// Of a command that compares values at the ends of runs: 2 in place of 0 or 5 where one of them
/// was cut short, which the standard error stream tells.
int code_with_cut_short(int code, const std::vector<io::RunSummary>& runs);

/// 130 after an interrupt, else 3 after a breakdown or an unsound end, else 5 where a run does not
/// hold what its case asks, else 0, with lines on the standard error stream. @param to_go_on  what
/// the user finds and does after an interrupt
int exit_code_of_study(const std::vector<report::Breakdown>& breakdowns,
                       const std::vector<io::RunSummary>& runs,
                       const std::string& to_go_on);

}  // namespace diptych::harness
