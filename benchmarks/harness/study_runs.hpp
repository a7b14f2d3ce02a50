#pragma once
/// The runs of a study: every variant, method and level, timed as often as asked. Repetitions go
/// round the curves, so that a slow minute of the machine hits all of them. A run that breaks down
/// is left out and the others go on. Test: tests/command_line/study_test.cpp

#include "benchmarks/harness/study_verb.hpp"
#include "benchmarks/harness/variants.hpp"
#include "benchmarks/harness/work_precision.hpp"

namespace diptych::harness {

struct StudyRuns {
  std::vector<WorkCurve> curves;        ///< those with a run at least
  std::string field;                    ///< whose error is shown; empty without an exact solution
  std::vector<std::string> breakdowns;  ///< what is known of each
};

bool has_exact(const run::Case& setup);

/// @param cases  of the variants
/// @throws base::InputError where --field is not measured, after the first run
StudyRuns runs_of_study(const StudyRequest& request,
                        const std::vector<Variant>& variants,
                        const std::vector<run::Case>& cases);

}  // namespace diptych::harness
