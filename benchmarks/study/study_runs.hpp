#pragma once
/// The runs of a study: every variant, method and level, timed as often as asked. Repetitions go
/// round the curves, so that a slow minute of the machine hits all of them. A run that breaks down
/// is left out and the others go on. Test: tests/command_line/study_test.cpp

#include "benchmarks/run/output_folder.hpp"
#include "benchmarks/study/study_verb.hpp"
#include "benchmarks/study/variants.hpp"
#include "benchmarks/study/work_precision.hpp"

namespace diptych::harness {

struct StudyRuns {
  std::vector<WorkCurve> curves;              ///< those with a run at least
  std::string field;                          ///< whose error is shown, or empty
  std::vector<report::Breakdown> breakdowns;  ///< with the variant in the message
};

bool has_exact(const cases::Case& setup);

/// @param cases   of the variants
/// @param output  prepared once the first run has shown that what was asked makes sense
/// @throws base::InputError where --field is not measured, after the first run
StudyRuns runs_of_study(const StudyRequest& request,
                        const std::vector<Variant>& variants,
                        const std::vector<cases::Case>& cases,
                        OutputFolder& output);

}  // namespace diptych::harness
