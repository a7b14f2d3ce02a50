#pragma once
/// What the verbs that run a case ask for alike: the case, its level, overrides, output.

#include "benchmarks/convergence/convergence.hpp"
#include "benchmarks/study/study.hpp"
#include "benchmarks/terminal/output.hpp"
#include "benchmarks/verbs/command_line.hpp"
#include "common/cases/case.hpp"

#include <string>
#include <vector>

namespace diptych::verbs {

/// Of the option --cases.
constexpr const char* cases_help =
    "folder of cases, DIR/NAME/case.toml, in which names are looked up in place of the shipped "
    "ones";

struct CaseArguments {
  std::string case_name, cases_folder, method = "both", directory, restart;
  std::string partition;  ///< empty: that of the options
  std::vector<std::string> overrides, with;
  int level = 0, threads = 0;
  bool quiet = false, no_fields = false, force = false, no_variants = false;

  /// Adds `case` and --cases.
  void declare_case(CommandLine& line);
  /// Adds these, --level, --threads, --set, --out, --quiet, --no-fields.
  void declare(CommandLine& line);
  /// Adds --force, of verbs that write results of the case.
  void declare_force(CommandLine& line);
  /// Adds --with and --no-variants, of verbs that compare.
  void declare_variants(CommandLine& line);
  /// Adds --partition.
  void declare_partition(CommandLine& line);
  /// Adds --restart.
  void declare_restart(CommandLine& line);
  /// Adds --method too.
  void declare_with_method(CommandLine& line);

  /// Path of the case file. @throws base::InputError
  std::string file() const;
  /// The case with its overrides. @throws base::InputError
  cases::Case read() const;
  /// Both methods, or the one named. @throws base::InputError for an unknown name
  std::vector<std::string> methods() const;
  /// --out, or results/CASE.
  std::string output_folder(const cases::Case& setup) const;
  /// n levels from that of --level on. @throws base::InputError for fewer than `least`
  std::vector<int> levels(int n, int least) const;
  /// A study of one level with all that was asked.
  harness::StudyOptions study_options(const cases::Case& setup) const;
  /// The same with the variants as further columns. @throws base::InputError
  harness::StudyOptions comparison_options(const cases::Case& setup) const;
};

/// --threads, with its range.
void declare_threads(CommandLine& line, int& threads);

using harness::print;
using harness::write_output;

/// The runs that broke down; nothing where none did.
void print_breakdowns(const harness::Study& study);

/// The runs that their step limit ended; nothing where there is none. @param left_out  see
/// cut_short_table
void print_cut_short(const harness::Study& study, bool left_out);

/// How far its runs are from the values from elsewhere that the case names, or why that is not
/// judged; nothing where it names none.
void print_references(const cases::Case& setup, const harness::Study& study);
/// Why values from elsewhere are held against nothing: those of another scene than the runs', and
/// those that begin after their end.
void print_references_left_out(const cases::Case& setup, const harness::Study& study);

/// Of a command without levels that was interrupted: where what it has is, and how to go on.
std::string end_of(const harness::Study& study, const std::string& folder);

/// See exit_code_of_study; but 2 where a method was refused, with lines on the standard error
/// stream.
int exit_code_of(const harness::Study& study, const std::string& to_go_on);

/// Writes DIR/report.html and says so. @param convergence  of the runs; empty: of one level
void write_report(const cases::Case& setup,
                  const harness::Study& study,
                  const std::string& folder,
                  const std::vector<harness::ColumnConvergence>& convergence = {});

}  // namespace diptych::verbs
