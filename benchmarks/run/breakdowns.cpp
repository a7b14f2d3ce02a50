#include "benchmarks/run/breakdowns.hpp"

#include "benchmarks/run/interruption.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "postprocess/report/orders.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <iterator>

namespace diptych::harness {

namespace {

std::string place_of(const report::Breakdown& one) {
  if (!one.place) return "-";
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", (*one.place)[0], (*one.place)[1], (*one.place)[2]);
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

report::Breakdown breakdown_of(const io::RunSummary& run) {
  const io::RunFailure failure = run.failure.value_or(io::RunFailure{});
  return {run.column(),
          run.level,
          failure.time.value_or(run.end_time),
          failure.step.value_or(run.steps),
          failure.node.value_or(-1),
          failure.message,
          failure.place};
}

std::string breakdown_message(const io::RunSummary& run) {
  return fmt::format("{} level {}: {}", run.column(), run.level, run.failure->message);
}

std::string breakdown_table(const std::vector<report::Breakdown>& breakdowns) {
  if (breakdowns.empty()) return "";
  size_t width = 12;
  for (const report::Breakdown& one : breakdowns)
    width = std::max(width, report::column_title(one.column).size());
  const std::string head = fmt::format("{:<{}}{:>6}{:>13}{:>10}{:>10}  {}", "broke down", width,
                                       "level", "time [s]", "step", "node", "place [m]");
  std::string text = head + "\n" + std::string(68 + width, '-') + "\n";
  for (const report::Breakdown& one : breakdowns) {
    text += fmt::format("{:<{}}{:>6}{:>13.6g}{:>10}{:>10}  {}\n", report::column_title(one.column),
                        width, one.level, one.time, one.step,
                        one.node < 0 ? "-" : std::to_string(one.node), place_of(one));
  }
  for (const report::Breakdown& one : breakdowns)
    text += base::folded(fmt::format("{} level {}: {}\n", one.column, one.level, one.message), 2);
  return text;
}

std::vector<io::RunSummary> cut_short(const std::vector<io::RunSummary>& runs) {
  std::vector<io::RunSummary> some;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(some),
               [](const io::RunSummary& run) { return run.status == "step limit"; });
  return some;
}

std::string cut_short_message(const io::RunSummary& run) {
  return fmt::format("{} level {} ended at its step limit (time.max_steps): step {}, t = {:.6g} s",
                     run.column(), run.level, run.steps, run.end_time);
}

std::string cut_short_table(const std::vector<io::RunSummary>& runs, bool left_out) {
  std::string text;
  for (const io::RunSummary& run : cut_short(runs)) {
    text += base::folded(
        cut_short_message(run) + ", before time.end" +
            (left_out ? "; it is left out of what compares values at the end\n" : "\n"),
        2);
  }
  return text;
}

int code_with_cut_short(int code, const std::vector<io::RunSummary>& runs) {
  const auto some = cut_short(runs);
  for (const io::RunSummary& run : some)
    std::fputs(fmt::format("diptych: {}\n", cut_short_message(run)).c_str(), stderr);
  const bool is_worse = code != static_cast<int>(base::ExitCode::done) &&
                        code != static_cast<int>(base::ExitCode::bound_not_met);
  return some.empty() || is_worse ? code : static_cast<int>(base::ExitCode::wrong_input);
}

int exit_code_of_study(const std::vector<report::Breakdown>& breakdowns,
                       const std::vector<io::RunSummary>& runs,
                       const std::string& to_go_on) {
  if (const int code = exit_code_of_study(to_go_on); code != 0) return code;
  for (const report::Breakdown& one : breakdowns) {
    std::fputs(fmt::format("diptych: {} level {} broke down: {}\n", one.column, one.level,
                           first_line(one.message))
                   .c_str(),
               stderr);
  }
  bool is_sound = breakdowns.empty(), is_met = true;
  const auto say = [](const io::RunSummary& run, const std::string& what) {
    std::fputs(fmt::format("diptych: {} level {} {}\n", run.column(), run.level, what).c_str(),
               stderr);
  };
  for (const io::RunSummary& run : runs) {
    if (run.status == "unsound") {
      is_sound = false;
      say(run, fmt::format("is unsound: from t = {:.4g} s on cells are inside out",
                           run.inverted_from.value_or(run.end_time)));
    }
    if (run.unmet.empty()) continue;
    is_met = false;
    say(run, "does not hold what the case asks: " + run.unmet);
  }
  if (!is_sound) return static_cast<int>(base::ExitCode::breakdown);
  return static_cast<int>(is_met ? base::ExitCode::done : base::ExitCode::bound_not_met);
}

}  // namespace diptych::harness
