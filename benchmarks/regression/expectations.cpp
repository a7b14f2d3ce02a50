/// The pass numbers of a case: its section [expect] against runs of the case as it stands.

#include "benchmarks/campaign/campaign.hpp"
#include "benchmarks/regression/regress.hpp"
#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/judgement.hpp"
#include "benchmarks/run/menus.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace diptych::harness {

namespace {

using cases::UnmetCase;

/// In the order of the case.
std::vector<UnmetCase> unmet_of(const cases::ExpectCase& expect, const ExpectedRun& asked) {
  std::vector<UnmetCase> entries;
  std::copy_if(expect.unmet.begin(), expect.unmet.end(), std::back_inserter(entries),
               [&](const UnmetCase& entry) {
                 return entry.method == asked.method && entry.variant == asked.variant;
               });
  return entries;
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

RegressCheck met(const std::string& figure, const std::string& note) {
  return {expect_check, figure, Verdict::met, 0, 0, note};
}

/// How a run ended against how it is to end.
/// @param stops  part of the message that is to stop it; empty: it is to come to its end
std::vector<RegressCheck> ending_checks(const std::string& prefix,
                                        const io::RunSummary& run,
                                        const std::string& stops,
                                        std::int64_t by_step) {
  const bool is_stopped = run.status == "breakdown";
  const std::string message = run.failure ? run.failure->message : "";
  const std::string figure = prefix + "ending";
  if (!cut_short({run}).empty())
    return {failure(expect_check, figure, cut_short_message(run), base::ExitCode::wrong_input)};
  if (stops.empty()) {
    if (!is_stopped) return {met(figure, run.status)};
    return {failure(expect_check, figure, "is stopped: " + first_line(message),
                    base::ExitCode::breakdown)};
  }
  if (!is_stopped)
    return {failure(expect_check, figure, fmt::format("is not stopped with '{}'", stops))};
  if (message.find(stops) == std::string::npos) {
    return {failure(
        expect_check, figure,
        fmt::format("is stopped without '{}' in its message: {}", stops, first_line(message)))};
  }
  std::vector<RegressCheck> checks{met(figure, first_line(message))};
  if (by_step > 0) {
    const auto step = run.failure->step.value_or(run.steps);
    checks.push_back(checked(expect_check, prefix + "step of the stop", static_cast<double>(step),
                             static_cast<double>(by_step)));
  }
  return checks;
}

bool all_met(const std::vector<RegressCheck>& checks) {
  return std::all_of(checks.begin(), checks.end(),
                     [](const RegressCheck& check) { return check.verdict == Verdict::met; });
}

/// What [expect] asks for, whatever is known.
std::vector<RegressCheck> wished(const cases::ExpectCase& expect,
                                 const std::string& prefix,
                                 const io::RunSummary& run,
                                 const std::vector<io::HistoryRow>& history) {
  std::vector<RegressCheck> checks = ending_checks(prefix, run, expect.stops, expect.by_step);
  if (!expect.stops.empty() || !run.is_ended()) return checks;
  for (const AskedBound& asked : asked_of(run, history, expect.holds)) {
    RegressCheck check =
        checked(expect_check, prefix + asked.bound.figure, asked.measured, asked.bound.value);
    check.at_least = !asked.bound.at_most;
    check.verdict = asked.is_met() ? Verdict::met : Verdict::failed;
    checks.push_back(check);
  }
  return checks;
}

/// What does not hold becomes known, if the run ends as the case says that it does today.
std::vector<RegressCheck> judged_by(const UnmetCase& unmet,
                                    const std::string& prefix,
                                    const io::RunSummary& run,
                                    std::vector<RegressCheck> checks) {
  const auto is_of_entry = [&](const RegressCheck& check) {
    return unmet.figure.empty() || check.figure == prefix + unmet.figure;
  };
  std::vector<RegressCheck> concerned;
  std::copy_if(checks.begin(), checks.end(), std::back_inserter(concerned), is_of_entry);
  if (concerned.empty()) {  // of a run that was stopped, or of a figure that no bound is on
    checks.push_back(failure(
        expect_check, prefix + "unmet",
        fmt::format("{}'{}' was not judged", functions::prefix(unmet.where), unmet.figure)));
    return checks;
  }
  if (all_met(concerned)) {
    std::erase_if(checks, is_of_entry);
    checks.push_back(failure(expect_check, prefix + "unmet",
                             fmt::format("{}the pass numbers are met now: remove this entry ({})",
                                         functions::prefix(unmet.where), unmet.because)));
    return checks;
  }
  const auto endings = ending_checks(prefix, run, unmet.stops, unmet.by_step);
  if (!all_met(endings)) return endings;
  for (RegressCheck& check : checks) {
    if (check.verdict != Verdict::failed || !is_of_entry(check)) continue;
    check.verdict = Verdict::known;
    check.note += (check.note.empty() ? "" : "; ") + unmet.because;
  }
  if (endings.size() > 1) checks.push_back(endings.back());
  return checks;
}

}  // namespace

std::vector<ExpectedRun> expected_runs(const cases::ExpectCase& expect) {
  std::vector<std::string> variants{""};
  variants.insert(variants.end(), expect.variants.begin(), expect.variants.end());
  std::vector<ExpectedRun> runs;
  const std::vector<std::string> methods = method_menu().names();
  for (const std::string& method : methods) {
    for (const std::string& variant : variants) {
      const bool is_of_another = std::any_of(methods.begin(), methods.end(), [&](const auto& m) {
        return m != method && variant.starts_with(m + ".");
      });
      if (!is_of_another) runs.push_back({method, variant});
    }
  }
  return runs;
}

std::vector<RegressCheck> expectation_checks(const cases::ExpectCase& expect,
                                             const ExpectedRun& asked,
                                             const io::RunSummary& run,
                                             const std::vector<io::HistoryRow>& history) {
  const std::string prefix = asked.variant.empty() ? "" : asked.variant + ", ";
  std::vector<RegressCheck> checks = wished(expect, prefix, run, history);
  for (const UnmetCase& unmet : unmet_of(expect, asked))
    checks = judged_by(unmet, prefix, run, std::move(checks));
  return checks;
}

std::map<std::string, ExpectationMeasurement> measure_expectations(const cases::Case& setup,
                                                                   int threads) {
  const std::vector<ExpectedRun> runs = expected_runs(setup.expect);
  std::vector<cases::Case> variants;
  for (const ExpectedRun& one : runs) {
    variants.push_back(one.variant.empty() ? setup : harness::read_case(setup.file, {one.variant}));
  }
  std::vector<CampaignRun> plan;
  for (size_t i = 0; i < runs.size(); ++i) {
    RunOptions options;
    options.method = runs[i].method;
    options.threads = threads;
    options.fields = false;
    options.quiet = true;
    plan.push_back({&variants[i], options, runs[i].method + runs[i].variant, runs[i].method});
  }
  std::map<std::string, ExpectationMeasurement> measured;
  make_runs(plan, TakeOver::nothing, [&](size_t i, const CampaignResult& made, const Schedule&) {
    ExpectationMeasurement& of_method = measured[runs[i].method];
    of_method.seconds += made.run.summary.wall_seconds;
    for (const RegressCheck& check :
         expectation_checks(variants[i].expect, runs[i], made.run.summary, made.run.history))
      of_method.checks.push_back(check);
  });
  return measured;
}

}  // namespace diptych::harness
