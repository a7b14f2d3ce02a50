/// diptych compare: both methods on the same nodes, what they cost, how far they are apart.

#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/history_differences.hpp"
#include "benchmarks/run/run_table.hpp"
#include "benchmarks/terminal/tables.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"

#include <memory>

namespace diptych::verbs {

namespace {

int compare_methods(const CaseArguments& arguments) {
  const cases::Case setup = arguments.read();
  auto options = arguments.study_options(setup);
  options.shapes = true;
  const harness::Study study = harness::run_study(setup, options);
  if (study.runs.size() == 2) {
    std::vector<std::string> probes;
    for (const auto& probe : setup.probes)
      probes.push_back(probe.name);
    const auto apart = harness::history_differences(
        probes, study.histories.at(study.runs[0].method), study.histories.at(study.runs[1].method));
    print(harness::comparison_table(study.runs[0], study.runs[1], study.differences, apart));
    for (const auto& summary : study.runs)
      print(harness::inverted_cells_warning(summary));
  } else {  // the other one broke down, or was never begun
    for (const auto& summary : study.runs)
      print(harness::run_table(summary) + "\n");
  }
  print_breakdowns(study);
  if (study.runs.size() + study.breakdowns.size() == 2)
    write_report(setup, study, options.directory);
  return harness::exit_code_of_study(study.breakdowns, end_of(study, options.directory));
}

}  // namespace

Action declare_compare(CommandLine& line) {
  const auto arguments = std::make_shared<CaseArguments>();
  arguments->declare(line);
  arguments->declare_force(line);
  return [arguments] { return compare_methods(*arguments); };
}

}  // namespace diptych::verbs
