#pragma once
/// What `--restart latest` and `--restart FILE` ask of a study of one level.
/// Test: tests/command_line/restart_test.cpp

#include "benchmarks/study/study.hpp"
#include "common/cases/case.hpp"

#include <string>

namespace diptych::verbs {

/// Sets methods and checkpoints of the options. latest: each method goes on from the latest whole
/// checkpoint in its folder, is taken over where it is finished there, and begins where it has
/// none. FILE: its method alone.
/// @param restart     "latest" or a path; empty: nothing is set
/// @param has_folder  the user has named the folder of the output: else it is that of the file
/// @throws base::InputError where there is nothing to go on from, or the file lies elsewhere
void go_on(const cases::Case& setup,
           const std::string& restart,
           bool has_folder,
           harness::StudyOptions& options);

}  // namespace diptych::verbs
