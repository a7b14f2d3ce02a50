/// Makes the runs of a verification table.

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "benchmarks/verifier/verification.hpp"
#include "common/base/error.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

/// "one branch, 20 %" as part of a path: "one-branch-20"
std::string folder_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  return name;
}

/// The table that goes without its last row of levels.
VerificationTable quicker(VerificationTable table) {
  for (VerificationRun& entry : table.runs) {
    if (entry.levels.size() < 2 || entry.levels.front() == entry.levels.back()) continue;
    entry.levels.pop_back();
    for (auto& [key, values] : entry.vary)
      values.pop_back();
  }
  return table;
}

std::vector<std::string> overrides_of(const VerificationRun& entry, size_t row) {
  std::vector<std::string> overrides = entry.set;
  for (const auto& [key, values] : entry.vary)
    overrides.push_back(key + "=" + values[row]);
  return overrides;
}

std::string label_of(const VerificationRun& entry, size_t row) {
  std::vector<std::string> parts;
  for (const auto& [key, values] : entry.vary)
    parts.push_back(key + " = " + values[row]);
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Runs, or takes over, one row; a breakdown is a result.
VerificationRow row_of(const VerificationTable& table,
                       const VerificationSequence& sequence,
                       size_t i,
                       int repetition,
                       const VerificationOptions& options) {
  const VerificationRun& entry = table.runs[sequence.run];
  RunOptions run_options;
  run_options.method = sequence.method;
  run_options.level = entry.levels[i];
  run_options.threads = options.threads;
  run_options.fields = false;
  run_options.quiet = options.quiet || isatty(STDERR_FILENO) == 0;
  run_options.measures = table.measures;
  run_options.schedule = options.schedule;
  fs::path folder = fs::path(options.directory) / table.name / folder_name(entry.name) /
                    fmt::format("row_{}", i + 1) / sequence.method;
  if (repetition > 0) folder += fmt::format("_again_{}", repetition);
  run_options.directory = folder.string();
  const cases::Case setup = harness::read_case(find_case(entry.case_name), overrides_of(entry, i));
  VerificationRow row;
  row.label = label_of(entry, i);
  const auto finished = options.fresh ? std::nullopt : finished_run(setup, run_options);
  if (finished) {
    row.summary = finished->summary;
    row.taken_over = true;
    return row;
  }
  try {
    row.summary = run_case(setup, run_options).summary;
    if (row.summary.status != "done") row.failure = row.summary.status;
  } catch (const base::BreakdownError& error) {
    row.summary.level = entry.levels[i];
    row.failure = error.what();
  } catch (const base::Interruption& error) {
    row.failure = error.what();  // while a mesh was made; nothing of the row is kept
  }
  return row;
}

/// A line of a run that is over, with its number in the command and the time left.
void tell(const VerificationRow& row, const std::string& what, const VerificationOptions& options) {
  if (options.quiet) return;
  const std::string outcome = row.taken_over         ? "taken over, not run again"
                              : !row.failure.empty() ? row.failure
                                                     : duration_text(row.summary.wall_seconds);
  std::string position;
  if (options.schedule != nullptr && options.schedule->n_runs() > options.schedule->current()) {
    position = fmt::format("; {} of {}", options.schedule->current(), options.schedule->n_runs());
    if (const auto left = options.schedule->seconds_left())
      position += fmt::format(", about {} left", duration_text(*left));
  }
  std::fputs(fmt::format("  {}: {}{}\n", what, outcome, position).c_str(), stderr);
}

/// One run of a table: a row of a sequence, of which timings are repeated.
struct RowTurn {
  size_t sequence, row;
  int repetition;
};

/// In the order in which they are made: runs of one row stand next to each other in time, so that
/// their costs compare.
std::vector<RowTurn> turns_of(const VerificationResult& result) {
  const VerificationTable& table = result.table;
  size_t n_rows = 0;
  for (const VerificationRun& entry : table.runs)
    n_rows = std::max(n_rows, entry.levels.size());
  std::vector<RowTurn> turns;
  for (const std::string& method : method_menu().names()) {
    for (size_t row = 0; row < n_rows; ++row) {
      for (int repetition = 0; repetition < table.repeat; ++repetition) {
        for (size_t k = 0; k < result.sequences.size(); ++k) {
          const VerificationSequence& sequence = result.sequences[k];
          if (sequence.method == method && row < table.runs[sequence.run].levels.size())
            turns.push_back({k, row, repetition});
        }
      }
    }
  }
  return turns;
}

/// The table with its sequences, none of which has a row.
VerificationResult unrun(const VerificationTable& table, const VerificationOptions& options) {
  VerificationResult result;
  result.table = options.quick ? quicker(table) : table;
  for (size_t r = 0; r < result.table.runs.size(); ++r) {
    for (const std::string& method : result.table.runs[r].methods)
      result.sequences.push_back({r, method, {}});
  }
  return result;
}

/// @return false after an interrupt
bool take_turn(VerificationResult& result,
               const RowTurn& turn,
               const VerificationOptions& options) {
  VerificationSequence& sequence = result.sequences[turn.sequence];
  const VerificationRun& entry = result.table.runs[sequence.run];
  const VerificationRow row = row_of(result.table, sequence, turn.row, turn.repetition, options);
  if (interrupt_requested()) return false;
  if (turn.repetition == 0) sequence.rows.push_back(row);
  io::RunSummary& kept = sequence.rows.back().summary;
  kept.loop_seconds = std::min(kept.loop_seconds, row.summary.loop_seconds);
  if (options.schedule != nullptr) {
    options.schedule->finish(row.failure.empty() ? std::optional(row.summary.wall_seconds)
                                                 : std::nullopt);
  }
  tell(row,
       fmt::format("{}: {}{}{}, {} level {}", result.table.name, entry.name,
                   row.label.empty() ? "" : ", ", row.label, sequence.method,
                   entry.levels[turn.row]),
       options);
  return true;
}

}  // namespace

std::vector<PlannedRun> planned_runs(const VerificationTable& table,
                                     const VerificationOptions& options) {
  const VerificationResult result = unrun(table, options);
  std::vector<int> dimension;  // of each run of the table: what it varies does not change it
  for (const VerificationRun& entry : result.table.runs) {
    const cases::Case setup =
        harness::read_case(find_case(entry.case_name), overrides_of(entry, 0));
    dimension.push_back(cases::dimension_of(setup.mesh));
  }
  std::vector<PlannedRun> runs;
  for (const RowTurn& turn : turns_of(result)) {
    const VerificationSequence& sequence = result.sequences[turn.sequence];
    const VerificationRun& entry = result.table.runs[sequence.run];
    runs.push_back({fmt::format("{}/{}/{}", table.name, entry.name, sequence.method),
                    entry.case_name + "/" + sequence.method, entry.levels[turn.row],
                    dimension[sequence.run]});
  }
  return runs;
}

std::optional<VerificationResult> verify(const VerificationTable& table,
                                         const VerificationOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  VerificationResult result = unrun(table, options);
  for (const RowTurn& turn : turns_of(result)) {
    if (!take_turn(result, turn, options)) return std::nullopt;
  }
  evaluate(result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace diptych::harness
