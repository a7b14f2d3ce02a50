/// diptych converge: levels of refinement, errors with observed orders, extrapolated quantities.

#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/run_table.hpp"
#include "benchmarks/terminal/tables.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/io/run_record.hpp"
#include "common/run/probes.hpp"

#include <filesystem>
#include <memory>

namespace diptych::verbs {

namespace {

struct ConvergeArguments : CaseArguments {
  int n_levels = 3;
  bool fresh = false;
  std::vector<std::string> quantities;
};

std::vector<harness::ColumnConvergence> finished_levels(const harness::Study& study,
                                                        const std::vector<std::string>& columns) {
  std::vector<harness::LevelRecord> records;
  for (size_t i = 0; i < study.runs.size(); ++i) {
    if (!study.runs[i].is_ended()) continue;
    const std::string file = (std::filesystem::path(study.directories[i]) / "history.csv").string();
    records.push_back({study.runs[i], io::history_columns_from_csv(io::read_file(file), file)});
  }
  return harness::convergence_of(records, columns);
}

/// What is written and printed of the levels that are finished.
void show_convergence(const cases::Case& setup,
                      const ConvergeArguments& arguments,
                      const harness::Study& study,
                      const std::string& folder) {
  const auto convergence = finished_levels(study, arguments.quantities);
  for (const auto& column : convergence) {
    print(harness::convergence_table(column.levels) + "\n");
    const std::string table = harness::quantity_table(column);
    if (!table.empty()) print(table + "\n");
  }
  const std::string agreement = harness::agreement_table(convergence, harness::causes_of(setup));
  if (!agreement.empty()) print(agreement + "\n");
  print_references(setup, study);
  for (const auto& summary : study.runs)
    print(harness::inverted_cells_warning(summary));
  print_cut_short(study, true);
  print_breakdowns(study);
  if (convergence.empty()) return;
  write_output(folder, "convergence.csv", harness::convergence_csv(convergence));
  write_output(folder, "convergence.tex", harness::convergence_tex(convergence));
  const bool is_whole = study.broken.empty() && harness::cut_short(study.runs).empty() &&
                        !harness::interrupt_requested();
  if (study.shapes.size() < arguments.methods().size() && is_whole) {
    print(
        "bodies and difference of the methods: not all in this report, as a run of the finest "
        "level was\n  taken over; 'diptych compare' or --fresh gives them\n");
  }
  write_report(setup, study, folder, convergence);
}

/// Before anything is run: what histories will have is known.
void check_quantities(const cases::Case& setup,
                      const harness::StudyOptions& options,
                      const std::vector<std::string>& wanted) {
  std::vector<io::HistoryColumn> columns;
  const auto add = [&](const cases::Case& one) {
    const std::string header = io::history_header(run::probe_columns(one.probes, false));
    for (const auto& column : io::history_columns_from_csv(header, one.name))
      columns.push_back(column);
  };
  add(setup);
  for (const harness::Column& variant : options.variants)
    add(variant.setup);
  harness::check_columns(columns, wanted);
}

int converge(const ConvergeArguments& arguments) {
  const std::vector<int> levels = arguments.levels(arguments.n_levels, 2);
  const cases::Case setup = arguments.read();
  auto options = arguments.comparison_options(setup);
  options.fields = false;
  options.shapes = true;
  options.resume = !arguments.fresh;
  options.levels = levels;
  check_quantities(setup, options, arguments.quantities);
  const harness::Study study = harness::run_study(setup, options);
  for (const std::string& folder : study.taken_over)
    print("taken over, not run again: " + folder + "\n");
  if (!study.taken_over.empty()) print("\n");
  show_convergence(setup, arguments, study, options.directory);
  return harness::code_with_cut_short(exit_code_of(study, harness::go_on_from(options.directory)),
                                      study.runs);
}

}  // namespace

Action declare_converge(CommandLine& line) {
  const auto arguments = std::make_shared<ConvergeArguments>();
  arguments->declare_with_method(line);
  arguments->declare_force(line);
  arguments->declare_variants(line);
  line.option("--levels", arguments->n_levels, "number of levels, from --level on");
  line.flag("--fresh", arguments->fresh, "run finished levels again too");
  line.repeated("--quantity", arguments->quantities,
                "column of history.csv to extrapolate, or 'all'; repeatable (default: energies, "
                "least J, probes)");
  return [arguments] { return converge(*arguments); };
}

}  // namespace diptych::verbs
