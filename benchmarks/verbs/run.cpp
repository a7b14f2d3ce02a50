/// diptych run: a case with one method or both, from t = 0 or from a checkpoint.

#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/run_table.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/restart.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/run/references.hpp"

#include <memory>

namespace diptych::verbs {

namespace {

int run_methods(const CaseArguments& arguments) {
  const cases::Case setup = arguments.read();
  auto options = arguments.study_options(setup);
  options.keeps_checkpoints = true;
  options.differences = false;  // compare and converge print them
  options.goes_past_refusals = true;
  go_on(setup, arguments.restart, !arguments.directory.empty(), options);
  const harness::Study study = harness::run_study(setup, options);
  for (const std::string& directory : study.taken_over)
    print("taken over, not run again: " + directory + "\n");
  for (const auto& summary : study.runs)
    print(harness::run_table(summary, run::reference_times(setup)) + "\n");
  print_references_left_out(setup, study);
  print_cut_short(study, false);
  print_breakdowns(study);
  if (!study.is_empty()) print("output: " + options.directory + "\n");
  return exit_code_of(study, study.is_empty() ? end_of(study, options.directory)
                                              : harness::go_on_from_checkpoint(options.directory));
}

}  // namespace

Action declare_run(CommandLine& line) {
  const auto arguments = std::make_shared<CaseArguments>();
  arguments->declare_with_method(line);
  arguments->declare_force(line);
  arguments->declare_restart(line);
  arguments->declare_partition(line);
  return [arguments] { return run_methods(*arguments); };
}

}  // namespace diptych::verbs
