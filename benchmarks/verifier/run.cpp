/// Makes the runs of a verification table.

#include "benchmarks/campaign/campaign.hpp"
#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "benchmarks/verifier/verification.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <algorithm>
#include <cstdio>
#include <deque>
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

/// A run of the campaign: a row of a sequence of a table, of which timings are repeated.
struct RowTurn {
  size_t table, sequence, row;
  int repetition;
};

/// Of one table, in the order in which they are made: runs of one row stand next to each other in
/// time, so that their costs compare.
void add_turns(const VerificationResult& result, size_t t, std::vector<RowTurn>& turns) {
  const VerificationTable& table = result.table;
  size_t n_rows = 0;
  for (const VerificationRun& entry : table.runs)
    n_rows = std::max(n_rows, entry.levels.size());
  for (const std::string& method : method_menu().names()) {
    for (size_t row = 0; row < n_rows; ++row) {
      for (int repetition = 0; repetition < table.repeat; ++repetition) {
        for (size_t k = 0; k < result.sequences.size(); ++k) {
          const VerificationSequence& sequence = result.sequences[k];
          if (sequence.method == method && row < table.runs[sequence.run].levels.size())
            turns.push_back({t, k, row, repetition});
        }
      }
    }
  }
}

/// The table with its sequences, none of which has a row.
VerificationResult unrun(const VerificationTable& table, bool quick) {
  VerificationResult result;
  result.table = quick ? quicker(table) : table;
  for (size_t r = 0; r < result.table.runs.size(); ++r) {
    for (const std::string& method : result.table.runs[r].methods)
      result.sequences.push_back({r, method, {}});
  }
  return result;
}

/// @param setup  of the row
CampaignRun planned(const VerificationResult& result,
                    const RowTurn& turn,
                    const cases::Case& setup,
                    const VerificationOptions& options) {
  const VerificationTable& table = result.table;
  const VerificationSequence& sequence = result.sequences[turn.sequence];
  const VerificationRun& entry = table.runs[sequence.run];
  RunOptions run;
  run.method = sequence.method;
  run.level = entry.levels[turn.row];
  run.threads = options.threads;
  run.fields = false;
  run.quiet = options.quiet || isatty(STDERR_FILENO) == 0;
  run.measures = table.measures;
  fs::path folder = fs::path(options.directory) / table.name / folder_name(entry.name) /
                    fmt::format("row_{}", turn.row + 1) / sequence.method;
  if (turn.repetition > 0) folder += fmt::format("_again_{}", turn.repetition);
  run.directory = folder.string();
  CampaignRun planned{&setup, run, fmt::format("{}/{}/{}", table.name, entry.name, run.method),
                      entry.case_name + "/" + run.method};
  planned.repetition = turn.repetition;
  return planned;
}

/// A breakdown is a result.
VerificationRow row_of(const VerificationRun& entry, size_t row, const CampaignResult& made) {
  const io::RunSummary& run = made.run.summary;
  VerificationRow result;
  result.label = label_of(entry, row);
  result.taken_over = made.taken_over;
  if (run.status == "breakdown") {
    result.summary.level = run.level;
    result.failure = breakdown_message(run);
  } else {
    result.summary = run;
    if (!run.is_ended()) result.failure = run.status;
  }
  return result;
}

/// A line of a run that is over, with its number in the command and the time left.
void tell(const VerificationRow& row, const std::string& what, const Schedule& schedule) {
  const std::string outcome = row.taken_over         ? "taken over, not run again"
                              : !row.failure.empty() ? row.failure
                                                     : duration_text(row.summary.wall_seconds);
  std::string position;
  if (schedule.n_runs() > schedule.current()) {
    position = fmt::format("; {} of {}", schedule.current(), schedule.n_runs());
    if (const auto left = schedule.seconds_left())
      position += fmt::format(", about {} left", duration_text(*left));
  }
  std::fputs(fmt::format("  {}: {}{}\n", what, outcome, position).c_str(), stderr);
}

}  // namespace

std::optional<std::vector<VerificationResult>> verify(
    const std::vector<VerificationTable>& tables,
    const VerificationOptions& options,
    const std::function<void(const VerificationResult& result)>& done) {
  std::vector<VerificationResult> results;
  std::vector<RowTurn> turns;
  for (const VerificationTable& table : tables) {
    results.push_back(unrun(table, options.quick));
    add_turns(results.back(), results.size() - 1, turns);
  }
  std::deque<cases::Case> cases;  // whose places do not change
  std::vector<CampaignRun> plan;
  for (const RowTurn& turn : turns) {
    const VerificationResult& result = results[turn.table];
    const VerificationRun& entry = result.table.runs[result.sequences[turn.sequence].run];
    cases.push_back(harness::read_case(find_case(entry.case_name), overrides_of(entry, turn.row)));
    plan.push_back(planned(result, turn, cases.back(), options));
  }
  const auto add = [&](size_t number, const CampaignResult& made, const Schedule& schedule) {
    if (interrupt_requested()) return;
    const RowTurn& turn = turns[number];
    VerificationResult& result = results[turn.table];
    VerificationSequence& sequence = result.sequences[turn.sequence];
    const VerificationRun& entry = result.table.runs[sequence.run];
    const VerificationRow row = row_of(entry, turn.row, made);
    if (turn.repetition == 0) sequence.rows.push_back(row);
    io::RunSummary& kept = sequence.rows.back().summary;
    kept.loop_seconds = std::min(kept.loop_seconds, row.summary.loop_seconds);
    if (!options.quiet) {
      tell(row,
           fmt::format("{}: {}{}{}, {} level {}", result.table.name, entry.name,
                       row.label.empty() ? "" : ", ", row.label, sequence.method,
                       entry.levels[turn.row]),
           schedule);
    }
    if (number + 1 < turns.size() && turns[number + 1].table == turn.table) return;
    evaluate(result);
    done(result);
  };
  if (!make_runs(plan, options.fresh ? TakeOver::nothing : TakeOver::finished, add))
    return std::nullopt;
  return results;
}

}  // namespace diptych::harness
