#include "benchmarks/campaign/campaign.hpp"

#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/provenance.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/terminal/status_line.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/parallel/ranks.hpp"
#include "common/parallel/thread_count.hpp"

#include <fmt/format.h>
#include <map>
#include <utility>

namespace diptych::harness {

namespace {

/// Runs with the same key have the same result.
std::string key_of(const CampaignRun& run) {
  return fmt::format("{} {} {} {}", input_hash(*run.setup, run.options.measures),
                     run.options.column(), run.options.level, run.repetition);
}

Schedule schedule_of(const std::vector<CampaignRun>& plan) {
  std::vector<PlannedRun> runs;
  for (const CampaignRun& run : plan)
    runs.push_back({run.kind, run.family, run.options.level, cases::dimension_of(run.setup->mesh)});
  return Schedule(std::move(runs));
}

std::optional<RunResult> finished_before(const CampaignRun& run, TakeOver take_over) {
  if (take_over == TakeOver::nothing) return std::nullopt;
  auto finished = finished_run(*run.setup, run.options, take_over == TakeOver::ended);
  if (finished) renew_references(*run.setup, run.options.directory, *finished);
  if (!finished || take_over != TakeOver::timed) return finished;
  parallel::set_threads(run.options.threads);
  const parallel::Communicator* ranks = parallel::all_ranks();
  const bool same = finished->summary.threads == parallel::running_threads() &&
                    finished->summary.ranks == (ranks == nullptr ? 1 : ranks->size()) &&
                    finished->summary.provenance.cpu == provenance("").cpu;
  return same ? std::move(finished) : std::nullopt;
}

/// The result of a run that could not be begun, of which nothing was written.
RunResult not_begun(const CampaignRun& run, const std::string& status, const std::string& message) {
  RunResult result;
  result.summary.method = run.options.method;
  result.summary.variant = run.options.variant;
  result.summary.case_name = run.setup->name;
  result.summary.level = run.options.level;
  result.summary.status = status;
  result.summary.failure = io::RunFailure{message, {}, {}, {}, {}};
  return result;
}

RunResult made_now(const CampaignRun& run, const Schedule& schedule) {
  RunOptions options = run.options;
  options.schedule = &schedule;
  StatusLine status(options.quiet);
  if (!run.label.empty()) status.show(run.label);
  if (!run.may_be_refused) return attempt_case(*run.setup, options);
  try {
    return attempt_case(*run.setup, options);
  } catch (const base::InputError& error) {
    return not_begun(run, "failed", error.what());
  } catch (const base::BreakdownError& error) {
    return not_begun(run, "breakdown", error.what());
  }
}

/// What is kept of a run for others that ask for the same.
RunResult without_state(const RunResult& run) {
  RunResult kept;
  kept.summary = run.summary;
  kept.history = run.history;
  kept.exact = run.exact;
  return kept;
}

}  // namespace

bool make_runs(const std::vector<CampaignRun>& plan, TakeOver take_over, const CampaignStep& each) {
  Schedule schedule = schedule_of(plan);
  std::map<std::string, int> n_asked;
  for (const CampaignRun& run : plan)
    ++n_asked[key_of(run)];
  std::map<std::string, RunResult> asked_again;
  for (size_t i = 0; i < plan.size(); ++i) {
    const std::string key = key_of(plan[i]);
    const auto twin = asked_again.find(key);
    auto before = twin != asked_again.end() ? std::optional(twin->second)
                                            : finished_before(plan[i], take_over);
    CampaignResult result{{}, before.has_value()};
    try {
      result.run = before ? std::move(*before) : made_now(plan[i], schedule);
    } catch (const base::Interruption&) {
      return false;  // while a mesh was made: what was finished before stands
    }
    const io::RunSummary& run = result.run.summary;
    const bool is_short = run.status == "breakdown" || run.status == "failed";
    schedule.finish(is_short ? std::nullopt : std::optional(run.wall_seconds));
    if (--n_asked[key] > 0) asked_again[key] = without_state(result.run);
    each(i, std::move(result), schedule);
    if (interrupt_requested()) return false;
  }
  return true;
}

}  // namespace diptych::harness
