#pragma once
/// Runs that need not be made again: a folder whose summary says that the same program has finished
/// the same run there. Anything else, an unfinished run or an unreadable file, is no result.
/// Test: tests/command_line/resumption_test.cpp

#include "benchmarks/run/run_case.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

/// Hash of all that a run is given: case file, overrides, the bytes of its mesh file, measures.
std::string input_hash(const cases::Case& setup, const std::vector<NodeMeasure>& measures);

/// Summary, history, exact columns (where the case has an exact solution) and rows of every step
/// (where they are held against values from elsewhere) of the finished run in options.directory,
/// where method, level, input and program are those that a run with these options would have. A run
/// is deterministic, so that one that broke down would do so again.
/// @param broken_down  such a run counts as finished too
std::optional<RunResult> finished_run(const cases::Case& setup,
                                      const RunOptions& options,
                                      bool broken_down = false);

/// Holds a finished run against the values from elsewhere as their files are now: they are no part
/// of what it was given, and may have changed since. Where that says something else its summary is
/// written anew.
/// @param run  of finished_run  @throws base::EnvironmentError
void renew_references(const cases::Case& setup, const std::string& directory, RunResult& run);

}  // namespace diptych::harness
