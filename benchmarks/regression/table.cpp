/// The regression on a terminal.

#include "benchmarks/regression/report.hpp"
#include "benchmarks/terminal/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace diptych::harness {

namespace {

constexpr size_t most_lines = 6;  ///< failures, or changes, that are shown one by one

/// How far up to its bound, or beyond it; infinite where a number is missing.
double load(const RegressCheck& check) {
  double ratio = check.measured == 0 ? 0 : check.measured / check.bound;
  if (check.at_least) ratio = 1 / ratio;
  return std::isfinite(ratio) ? ratio : std::numeric_limits<double>::infinity();
}

std::string figure_text(const RegressCheck& check) {
  if (!std::isfinite(check.measured)) return check.figure + ": " + check.note;
  // a pass number tells a per cent from none
  const int digits = check.name == expect_check ? 4 : 2;
  return fmt::format("{} {:.{}g} of {}{:.{}g}", check.figure, check.measured, digits,
                     check.at_least ? "at least " : "", check.bound, digits);
}

/// Failures first, then what is nearest to its bound.
std::vector<RegressCheck> sorted(std::vector<RegressCheck> checks) {
  std::stable_sort(checks.begin(), checks.end(), [](const auto& a, const auto& b) {
    const bool a_failed = a.verdict == Verdict::failed, b_failed = b.verdict == Verdict::failed;
    return a_failed != b_failed ? a_failed : load(a) > load(b);
  });
  return checks;
}

std::string counts_text(const RegressRow& row) {
  const VerdictCounts counts = count_verdicts({row});
  std::string text;
  const auto add = [&](Verdict verdict, const char* word) {
    const size_t n = counts.of(verdict);
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, word);
  };
  add(Verdict::failed, "FAILED");
  add(Verdict::met, "met");
  add(Verdict::known, "known");
  return text.empty() ? "skipped" : text;
}

std::string line_of(const RegressRow& row) {
  std::vector<RegressCheck> judged;
  for (const RegressCheck& check : row.checks) {
    if (check.verdict != Verdict::skipped) judged.push_back(check);
  }
  std::string worst;
  if (!judged.empty()) {
    const RegressCheck first = sorted(judged).front();
    // what no number shows stands in full below
    worst = std::isfinite(first.measured) ? figure_text(first) : first.figure;
  } else if (!row.checks.empty()) {
    worst = row.checks.front().note;
  }
  return fmt::format("{:<29} {:<4} {:<16} {}\n", row.case_name, row.method, counts_text(row),
                     worst);
}

std::string failures_of(const RegressRow& row) {
  std::string text;
  std::vector<RegressCheck> failed;
  for (const RegressCheck& check : sorted(row.checks)) {
    if (check.verdict == Verdict::failed) failed.push_back(check);
  }
  for (size_t i = 0; i < failed.size() && i < most_lines; ++i) {
    text += "    FAILED " + failed[i].name + ": " + figure_text(failed[i]);
    if (std::isfinite(failed[i].measured) && !failed[i].note.empty())
      text += " (" + failed[i].note + ")";
    text += "\n";
  }
  if (failed.size() > most_lines)
    text += fmt::format("    and {} more\n", failed.size() - most_lines);
  return text;
}

/// What is not met as recorded: pass numbers, bounds, references, agreement; with the cause where
/// one is known.
std::string unmet_of(const RegressRow& row) {
  std::string text;
  for (const RegressCheck& check : row.checks) {
    if (check.verdict != Verdict::known || check.name == "conservation") continue;
    text += check.name == "agreement" ? "    apart: " : "    not met: ";
    text += figure_text(check);
    if (std::isfinite(check.measured) && !check.note.empty()) text += " (" + check.note + ")";
    text += "\n";
  }
  return text;
}

/// Reasons, each with the number of checks that were left out for it.
std::string skips_of(const std::vector<RegressRow>& rows) {
  std::map<std::string, size_t> reasons;
  for (const RegressRow& row : rows) {
    for (const RegressCheck& check : row.checks) {
      if (check.verdict == Verdict::skipped && !check.figure.empty())
        ++reasons[check.figure + ": " + check.note];
    }
  }
  std::string text;
  for (const auto& [reason, n] : reasons)
    text += fmt::format("skipped {} times: {}\n", n, reason);
  return text;
}

size_t count_failed(const std::vector<RegressRow>& rows, base::ExitCode code) {
  size_t n = 0;
  for (const RegressRow& row : rows) {
    n += std::count_if(row.checks.begin(), row.checks.end(), [&](const RegressCheck& check) {
      return check.verdict == Verdict::failed && check.code == code;
    });
  }
  return n;
}

/// Kinds of failure: the code of each, the first that applies is that of the whole.
struct FailureKind {
  base::ExitCode code;
  const char *one, *several;
};
constexpr std::array<FailureKind, 4> failure_kinds{
    {{base::ExitCode::environment, "failure of the environment", "failures of the environment"},
     {base::ExitCode::wrong_input, "file that cannot be used", "files that cannot be used"},
     {base::ExitCode::breakdown, "breakdown", "breakdowns"},
     {base::ExitCode::bound_not_met, "check failed", "checks failed"}}};

struct Change {
  std::string name;
  double old, now, relative;
};

void add_changes(std::vector<Change>& changes,
                 const std::string& where,
                 const RegressFigures& old,
                 const RegressFigures& now) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, figure] : now) {
    const auto found = old.find(name);
    if (found == old.end()) {
      changes.push_back(
          {where + name, nothing, figure.value, std::numeric_limits<double>::infinity()});
    } else if (found->second.value != figure.value) {
      changes.push_back({where + name, found->second.value, figure.value,
                         std::abs(figure.value - found->second.value) / found->second.scale});
    }
  }
  for (const auto& [name, figure] : old) {
    if (now.count(name) == 0)
      changes.push_back(
          {where + name, figure.value, nothing, std::numeric_limits<double>::infinity()});
  }
}

/// What is run from now on.
std::string size_text(const RegressBaseline& now) {
  std::string set;
  for (const std::string& entry : now.set)
    set += " --set " + entry;
  return fmt::format("  size:{}, {}\n", set.empty() ? " the case as it stands" : set,
                     now.levels == 1 ? "level 0 only: " + now.one_level_because : "levels 0 and 1");
}

}  // namespace

std::string regress_table(const std::vector<RegressRow>& rows) {
  std::string text = fmt::format("{:<29} {:<4} {:<16} {}\n", "case", "", "checks",
                                 "nearest to its bound, or worst beyond");
  for (const RegressRow& row : rows)
    text += line_of(row) + failures_of(row) + unmet_of(row);
  const VerdictCounts n = count_verdicts(rows);
  return text + skips_of(rows) +
         fmt::format("{} checks met, {} failed; {} beyond their bounds as recorded, {} skipped\n",
                     n.of(Verdict::met), n.of(Verdict::failed), n.of(Verdict::known),
                     n.of(Verdict::skipped));
}

VerdictCounts count_verdicts(const std::vector<RegressRow>& rows) {
  VerdictCounts counts;
  for (const RegressRow& row : rows) {
    for (const RegressCheck& check : row.checks)
      ++counts.n.at(static_cast<size_t>(check.verdict));
  }
  return counts;
}

bool has_failed(const std::vector<RegressRow>& rows) {
  return exit_code_of(rows) != base::ExitCode::done;
}

base::ExitCode exit_code_of(const std::vector<RegressRow>& rows) {
  for (const FailureKind& kind : failure_kinds) {
    if (count_failed(rows, kind.code) > 0) return kind.code;
  }
  return base::ExitCode::done;
}

std::string failures_in_words(const std::vector<RegressRow>& rows) {
  std::string text;
  for (const FailureKind& kind : failure_kinds) {
    const size_t n = count_failed(rows, kind.code);
    if (n == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, n == 1 ? kind.one : kind.several);
  }
  return text;
}

std::string difference_text(const RegressBaseline& old, const RegressBaseline& now) {
  std::string text = now.case_name + ": ";
  if (old.methods.empty()) {
    text += "first baseline\n";
  } else {
    text += fmt::format("{} of {} ({}) -> {} of {} ({})\n", old.commit, old.date, old.reason,
                        now.commit, now.date, now.reason);
  }
  text += size_text(now);
  std::vector<Change> changes;
  if (!old.methods.empty()) {
    for (const auto& [method, figures] : now.methods) {
      const auto found = old.methods.find(method);
      const MethodFigures before = found == old.methods.end() ? MethodFigures{} : found->second;
      add_changes(changes, method + " canary, ", before.canary, figures.canary);
      add_changes(changes, method + " error, ", before.errors, figures.errors);
      add_changes(changes, method + " ", before.quantities, figures.quantities);
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const auto& a, const auto& b) { return a.relative > b.relative; });
    text += changes.empty() ? "  no figure differs\n" : "";
  }
  for (size_t i = 0; i < changes.size() && i < most_lines; ++i) {
    text += fmt::format("  {}: {} -> {} ({:.1e})\n", changes[i].name,
                        number_text(changes[i].old, "{:.9g}", "none"),
                        number_text(changes[i].now, "{:.9g}", "none"), changes[i].relative);
  }
  if (changes.size() > most_lines)
    text += fmt::format("  and {} more that differ less\n", changes.size() - most_lines);
  for (const auto& [name, excess] : now.disagreement) {
    const auto found = old.disagreement.find(name);
    const std::string before =
        found == old.disagreement.end() ? "within" : fmt::format("{:.3g}", found->second);
    text += fmt::format("  methods differ by more than their error bars: {}, {} -> {:.3g}\n", name,
                        before, excess);
  }
  return text;
}

}  // namespace diptych::harness
