#include "benchmarks/verbs/case_arguments.hpp"

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/case_mesh.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/terminal/reference_table.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/reader.hpp"
#include "common/parallel/partition.hpp"
#include "common/parallel/ranks.hpp"
#include "common/parallel/thread_count.hpp"
#include "common/run/references.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <numeric>

namespace diptych::verbs {

void CaseArguments::declare_case(CommandLine& line) {
  line.word("case", case_name, "path of a case file or its folder, or a name of 'list'");
  line.option("--cases", cases_folder, cases_help);
}

void CaseArguments::declare(CommandLine& line) {
  declare_case(line);
  line.option("--level", level, "the mesh spacing is divided by 2^level");
  declare_threads(line, threads);
  line.repeated("--set", overrides, "key=value, overrides the case file; repeatable");
  line.option("--out", directory, "output folder (default results/CASE)");
  line.flag("--quiet", quiet, "no progress");
  line.flag("--no-fields", no_fields, "write no field frames");
}

void CaseArguments::declare_force(CommandLine& line) {
  line.flag("--force", force, "replace finished results in the output folder, of another case too");
}

void CaseArguments::declare_variants(CommandLine& line) {
  line.repeated("--with", with,
                "[NAME:] key=value [key=value...]: a further column, a variant of the method whose "
                "keys they are, or of both; repeatable");
  line.flag("--no-variants", no_variants, "leave out the [[variant]] of the case file");
}

void CaseArguments::declare_partition(CommandLine& line) {
  line.option("--partition", partition,
              "how mpirun's ranks share a body: metis (default), slab or bisection");
}

void CaseArguments::declare_restart(CommandLine& line) {
  line.option("--restart", restart,
              "go on from a checkpoint: latest, or the path of one in the output folder");
}

void CaseArguments::declare_with_method(CommandLine& line) {
  declare(line);
  line.option("--method", method, "sph, fvm or both");
}

std::string CaseArguments::file() const {
  return harness::find_case(case_name, cases_folder);
}

cases::Case CaseArguments::read() const {
  harness::check_level(level);
  return harness::read_case(file(), overrides);
}

std::vector<std::string> CaseArguments::methods() const {
  const std::vector<std::string> names = harness::method_menu().names();
  if (method == "both") return names;
  if (std::find(names.begin(), names.end(), method) == names.end()) {
    throw base::InputError(
        fmt::format("unknown method '{}'; known: {}, both", method, base::joined(names)));
  }
  return {method};
}

std::vector<int> CaseArguments::levels(int n, int least) const {
  if (n < least) throw base::InputError(fmt::format("--levels must be {} or more", least));
  harness::check_levels(level, n);
  std::vector<int> all(static_cast<size_t>(n));
  std::iota(all.begin(), all.end(), level);
  return all;
}

std::string CaseArguments::output_folder(const cases::Case& setup) const {
  if (!directory.empty()) return directory;
  return (std::filesystem::path("results") / setup.name).string();
}

harness::StudyOptions CaseArguments::study_options(const cases::Case& setup) const {
  harness::StudyOptions options;
  options.methods = methods();
  options.levels = {level};
  options.threads = threads;
  if (!partition.empty()) {
    parallel::partitioners().at(partition);
    if (parallel::all_ranks() == nullptr) {
      throw base::InputError(
          "--partition has no effect on one rank; start the command with "
          "mpirun -n N, or leave it out");
    }
    options.partition = partition;
  }
  options.directory = output_folder(setup);
  options.fields = !no_fields;
  options.quiet = quiet;
  options.force = force;
  return options;
}

harness::StudyOptions CaseArguments::comparison_options(const cases::Case& setup) const {
  harness::StudyOptions options = study_options(setup);
  options.variants = harness::variant_columns(setup, options.methods, {with, !no_variants});
  if (no_variants) return options;
  for (const std::string& name : harness::overridden_variants(setup)) {
    print(fmt::format(
        "variant '{}' of the case is left out: --set says something of what it sets\n", name));
  }
  return options;
}

void declare_threads(CommandLine& line, int& threads) {
  line.count("--threads", threads, 0, parallel::most_threads,
             "how many threads; 0: OMP_NUM_THREADS, or all processors");
}

void print_breakdowns(const harness::Study& study) {
  const std::string table = harness::breakdown_table(study.breakdowns());
  if (!table.empty()) print(table + "\n");
}

void print_cut_short(const harness::Study& study, bool left_out) {
  const std::string table = harness::cut_short_table(study.runs, left_out);
  if (!table.empty()) print((left_out ? "\n" : "") + table);
}

void print_references_left_out(const cases::Case& setup, const harness::Study& study) {
  if (study.runs.empty() || setup.references.empty()) return;
  const std::string changed = run::changed_scene(setup.overrides);
  if (!changed.empty()) {
    print(fmt::format(
        "\nvalues from elsewhere: not held against, --set {} makes it another scene\n", changed));
    return;
  }
  double end = 0;
  for (const io::RunSummary& run : study.runs)
    end = std::max(end, run.end_time);
  for (const cases::ReferenceCase& reference : setup.references) {
    const double from = reference.points.front()[0];
    if (from <= end * (1 + 1e-9)) continue;
    print(
        base::folded(fmt::format("{} against {}: not compared, the values begin at {:g} s and the "
                                 "run ends at {:g} s\n",
                                 reference.probe, reference.source, from, end),
                     2));
  }
}

void print_references(const cases::Case& setup, const harness::Study& study) {
  const std::string table = harness::reference_table(study.runs, run::reference_times(setup));
  if (!table.empty()) print("\n" + table);
  print_references_left_out(setup, study);
}

std::string end_of(const harness::Study& study, const std::string& folder) {
  return study.is_empty() ? "nothing had been computed; the same command begins again"
                          : harness::begin_again(folder);
}

int exit_code_of(const harness::Study& study, const std::string& to_go_on) {
  const int code = harness::exit_code_of_study(study.breakdowns(), study.runs, to_go_on);
  for (const harness::Refusal& one : study.refusals) {
    std::fputs(
        fmt::format("diptych: {} level {} was refused: {}\n", one.column, one.level, one.message)
            .c_str(),
        stderr);
  }
  const bool is_refused =
      !study.refusals.empty() && code != static_cast<int>(base::ExitCode::interrupted);
  return is_refused ? static_cast<int>(base::ExitCode::wrong_input) : code;
}

void write_report(const cases::Case& setup,
                  const harness::Study& study,
                  const std::string& folder,
                  const std::vector<harness::ColumnConvergence>& convergence) {
  const std::string path = (std::filesystem::path(folder) / "report.html").string();
  report::write_report(path, harness::report_of(setup, study, convergence));
  print("\nreport: " + path + "\n");
}

}  // namespace diptych::verbs
