#pragma once
/// Verification tables: each is one TOML file of benchmarks/verification that says what is run,
/// what is shown of it, and what is asked; those of benchmarks/literature are the cases without an
/// exact solution, on a page of their own. Adding a table is adding a file. Test:
/// tests/command_line/verification_test.cpp
///
///   title, text, note         what it shows and what is asked; what is known where a bound is
///   unmet order_in                  "spacing" (default) or "steps": what orders are taken in
///   repeat                    runs of each; `seconds` is the least of them
///   [parameters]              numbers that expressions may use
///   [[measure]]               name, reduce, value, where: numbers of the final state (NodeMeasure)
///   [[run]]                   name, case, levels, methods, set; [run.vary] key = one value a row
///   [[column]]                title, value, order, ratio_to, optional; group: a table of its own
///   under that heading; estimate: extrapolated from three levels, with error bars and the
///   agreement of the methods; literature: what is known of it, with its source
///   [[bound]]                 columns, runs, and one of least_order, most, least, most_spread

#include "benchmarks/run/node_measures.hpp"
#include "common/io/run_record.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::harness {

/// Runs of one case that follow each other: levels, values of overrides, or both side by side.
struct VerificationRun {
  std::string name, case_name;
  std::vector<int> levels;                                             ///< one for each row
  std::vector<std::string> methods;                                    ///< sph, fvm
  std::vector<std::string> set;                                        ///< "key=value"
  std::vector<std::pair<std::string, std::vector<std::string>>> vary;  ///< key: one value a row
};

struct VerificationColumn {
  std::string title, value;      ///< heading; expression of the numbers of a run
  functions::SourcePlace where;  ///< of the text of `value`
  bool order = false;            ///< with the observed order beside it
  std::string ratio_to;          ///< name of a run: divided by the value of the same row there
  bool optional = false;         ///< runs without such an error have no value
  std::string group;             ///< heading of the table that it stands in; empty: the first
  bool estimate = false;         ///< extrapolated, with error bars
  std::string literature;        ///< what others have found, and who
};

struct VerificationBound {
  enum class Kind { least_order, most, least, most_spread };
  Kind kind = Kind::most;
  double asked = 0;
  std::vector<std::string> columns, runs;  ///< titles and names
};

struct VerificationTable {
  std::string name, file, title, text, note;
  bool order_in_steps = false;
  int repeat = 1;
  std::map<std::string, double> parameters;
  std::vector<NodeMeasure> measures;
  std::vector<VerificationRun> runs;
  std::vector<VerificationColumn> columns;
  std::vector<VerificationBound> bounds;
};

/// @throws base::InputError with file:line:column
VerificationTable read_verification_table(const std::string& path);

/// Path of a table: a file, or the name of one in the folders of the shipped tables.
std::string find_verification_table(const std::string& name);

enum class VerificationSet { verification, literature };

/// Names of the shipped tables, sorted. Folder: the environment variable DIPTYCH_VERIFICATION
/// (DIPTYCH_LITERATURE), or the program's data.
std::vector<std::string> shipped_verification_tables(VerificationSet set);

/// One row: a run of one method, or how it failed.
struct VerificationRow {
  io::RunSummary summary;
  std::string label;          ///< of the varied values: "time.cfl = 0.2"
  std::string failure;        ///< empty where the run was finished
  std::vector<double> value;  ///< of each column; NaN where there is none
  std::vector<double> order;  ///< of each column, against the row before; NaN
  bool taken_over = false;
};

/// Rows of one method in one run of the table.
struct VerificationSequence {
  size_t run = 0;  ///< index
  std::string method;
  std::vector<VerificationRow> rows;
};

struct VerificationVerdict {
  std::string run, column, asked, method, measured;
  bool met = false;
};

struct VerificationResult {
  VerificationTable table;
  std::vector<VerificationSequence> sequences;
  std::vector<VerificationVerdict> verdicts;
};

struct VerificationOptions {
  std::string directory;  ///< runs go to DIRECTORY/<table>/<run>/<row>/<method>
  int threads = 0;
  bool fresh = false;  ///< runs that the same program has finished are run again too
  bool quick = false;  ///< without the last row of each sequence of levels
  bool quiet = false;
};

/// Runs what is not there yet.
/// @param done  told of every table once its last run is over
/// @return nothing where it was interrupted
std::optional<std::vector<VerificationResult>> verify(
    const std::vector<VerificationTable>& tables,
    const VerificationOptions& options,
    const std::function<void(const VerificationResult& result)>& done);

/// Values, orders and verdicts of rows whose summaries are there.
void evaluate(VerificationResult& result);

/// The tables of a set as one page of Markdown: that of the literature says what the machine can
/// do.
std::string verification_page(const std::vector<VerificationResult>& results,
                              VerificationSet set,
                              bool quick);

/// Values of the estimate columns of run r on its last levels: extrapolated, order, error bar, and
/// whether the methods agree within the sum of their bars. Empty where no column asks for it.
std::string estimates_section(const VerificationResult& result, size_t r);

/// Cells of one line each, aligned; the first is the heading.
/// @param left  columns that are set flush left; the others are numbers
std::string markdown_table(const std::vector<std::vector<std::string>>& lines, size_t left);

/// Three digits: 1.23e-04, 0.0594, 1.07, 452; "-" where it is not finite.
std::string table_number(double value);

/// What a terminal shows of a table: bounds met and those that are not.
std::string verification_lines(const VerificationResult& result);

}  // namespace diptych::harness
