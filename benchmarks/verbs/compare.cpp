/// diptych compare: both methods on the same nodes, variants beside them, what they cost, how far
/// they are apart.

#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/history_differences.hpp"
#include "benchmarks/run/run_table.hpp"
#include "benchmarks/terminal/tables.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/run/references.hpp"

#include <memory>

namespace diptych::verbs {

namespace {

/// The pair as ever, then all columns where there are more.
void print_comparison(const cases::Case& setup, const harness::Study& study) {
  const io::RunSummary *sph = study.run_of("sph"), *fvm = study.run_of("fvm");
  const bool has_both = sph != nullptr && fvm != nullptr && sph->is_ended() && fvm->is_ended();
  if (has_both) {
    std::vector<std::string> probes;
    for (const auto& probe : setup.probes)
      probes.push_back(probe.name);
    const auto apart =
        harness::history_differences(probes, study.histories.at("sph"), study.histories.at("fvm"));
    print(harness::comparison_table(*sph, *fvm, study.differences, apart));
    std::vector<io::RunSummary> ended;
    for (const auto& summary : study.runs) {
      if (summary.is_ended()) ended.push_back(summary);
    }
    if (ended.size() > 2) print("\n" + harness::columns_table(ended, study.distances));
    for (const auto& summary : study.runs)
      print(harness::inverted_cells_warning(summary));
  } else {  // the other one broke down, was refused, cut short or never begun
    for (const auto& summary : study.runs)
      print(harness::run_table(summary, run::reference_times(setup)) + "\n");
  }
}

int compare_methods(const CaseArguments& arguments) {
  const cases::Case setup = arguments.read();
  auto options = arguments.comparison_options(setup);
  options.shapes = true;
  options.goes_past_refusals = true;
  const harness::Study study = harness::run_study(setup, options);
  print_comparison(setup, study);
  print_references(setup, study);
  print_cut_short(study, true);
  print_breakdowns(study);
  if (study.has_all()) write_report(setup, study, options.directory);
  return harness::code_with_cut_short(exit_code_of(study, end_of(study, options.directory)),
                                      study.runs);
}

}  // namespace

Action declare_compare(CommandLine& line) {
  const auto arguments = std::make_shared<CaseArguments>();
  arguments->declare(line);
  arguments->declare_force(line);
  arguments->declare_variants(line);
  return [arguments] { return compare_methods(*arguments); };
}

}  // namespace diptych::verbs
