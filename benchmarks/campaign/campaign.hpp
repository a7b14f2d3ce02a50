#pragma once
/// A campaign: the runs of a command over levels, variants and methods, made one after another in
/// the order of its plan. What the same program has finished is taken over, what the plan asks for
/// twice is made once, a breakdown ends only its own run, an interrupt all that are left.
/// Tests: tests/harness/campaign_test.cpp, tests/command_line/resumption_test.cpp

#include "benchmarks/run/run_case.hpp"

#include <functional>
#include <string>
#include <vector>

namespace diptych::harness {

/// One run of the plan.
struct CampaignRun {
  const cases::Case* setup = nullptr;  ///< outlives the campaign
  RunOptions options;                  ///< its schedule is set by the campaign
  std::string kind, family;            ///< see PlannedRun
  std::string label = {};              ///< what a terminal shows until the run itself does
  int repetition = 0;                  ///< of a timing: runs that differ in it are all made
  bool may_be_refused = false;         ///< one that cannot be begun is a result: status "failed"
                                       ///< (wrong input) or "breakdown"
};

/// Which runs of earlier commands need not be made again.
enum class TakeOver {
  nothing,
  finished,  ///< those that finished_run() knows
  ended,     ///< and those that broke down
  timed      ///< of these, those of as many threads on the same kind of processor
};

struct CampaignResult {
  RunResult run;  ///< of one that is taken over: summary, history and exact columns
  bool taken_over = false;
};

/// What is done with a run that is over. @param number  in the plan
using CampaignStep =
    std::function<void(size_t number, CampaignResult result, const Schedule& schedule)>;

/// Makes the runs. After an interrupt the last one that `each` is given may not have come to its
/// end. @return false after an interrupt
/// @throws base::Error  of a run that could not be begun, and of `each`
bool make_runs(const std::vector<CampaignRun>& plan, TakeOver take_over, const CampaignStep& each);

}  // namespace diptych::harness
