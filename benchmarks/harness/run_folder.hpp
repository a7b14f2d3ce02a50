#pragma once
/// The folder that a run writes into: taking it, and what stands in it before and after the run.
/// Test: tests/command_line/bad_input_test.cpp

#include "benchmarks/harness/run_case.hpp"

#include <string>

namespace diptych::harness {

/// Creates DIR for a run, or takes one that an earlier run made (it has a summary.json).
/// @throws base::EnvironmentError where it cannot, base::InputError where it holds something else
void claim_directory(const std::string& directory);

/// Leaves word that a run is under way here: until it is over, no one takes what lies in its folder
/// for a result.
void announce(const RunOptions& options, io::RunSummary summary);

/// What a run that has ended leaves besides its frames.
void write_record(const run::Case& setup, const RunOptions& options, const RunResult& result);

}  // namespace diptych::harness
