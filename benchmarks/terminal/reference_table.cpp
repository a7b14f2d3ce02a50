#include "benchmarks/terminal/reference_table.hpp"

#include "benchmarks/terminal/text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// Names of the references that some run has a time of, in the order of the case.
std::vector<std::string> names_of(const std::vector<io::RunSummary>& runs) {
  std::vector<std::string> names;
  for (const io::RunSummary& run : runs) {
    for (const io::ReferenceSummary& one : run.references) {
      if (std::find(names.begin(), names.end(), one.name) == names.end()) names.push_back(one.name);
    }
  }
  return names;
}

std::string cell(double value) {
  return number_text(value, "{:.3g}");
}

std::string line_of(const io::RunSummary& run,
                    const io::ReferenceSummary& one,
                    const ReferenceTimes& times) {
  return fmt::format("  {:<20}{:>3}{:>10}{:>10}{:>10}{:>11}{:>9}  {}\n", run.column().substr(0, 20),
                     run.level, cell(one.greatest), cell(one.greatest_at), cell(one.rms),
                     cell(one.at_end), cell(one.until),
                     uncertainty_verdict(one, run.end_time, times));
}

std::string uncertainty_text(const io::ReferenceSummary& one) {
  return one.uncertainty ? fmt::format("+-{:.3g}", *one.uncertainty) : "no uncertainty stated";
}

}  // namespace

std::string uncertainty_verdict(const io::ReferenceSummary& reference,
                                double end,
                                const ReferenceTimes& times) {
  if (!reference.uncertainty) return "none stated";
  if (reference.is_inside()) {
    const auto all = times.find(reference.name);
    if (all == times.end()) return "met";
    const auto n = std::count_if(all->second.begin(), all->second.end(),
                                 [&](double t) { return t <= end * (1 + 1e-9); });
    const auto n_all = std::ssize(all->second);
    return n < n_all ? fmt::format("met at {} of {} times", n, n_all) : "met";
  }
  return fmt::format("NOT met, {} times",
                     number_text(reference.greatest / *reference.uncertainty, "{:.2g}"));
}

std::string reference_table(const std::vector<io::RunSummary>& runs, const ReferenceTimes& times) {
  const std::vector<std::string> names = names_of(runs);
  if (names.empty()) return "";
  std::string text = fmt::format(
      "{}: distance from values from elsewhere at their times, in the unit of the probe\n",
      runs.front().case_name);
  text += fmt::format("  {:<18}{:>5}{:>10}{:>10}{:>10}{:>11}{:>9}  {}\n", "", "level", "largest",
                      "at [s]", "rms", "at the end", "end [s]", "within it");
  text += std::string(100, '-') + "\n";
  for (const std::string& name : names) {
    bool is_titled = false;
    for (const io::RunSummary& run : runs) {
      for (const io::ReferenceSummary& one : run.references) {
        if (one.name != name) continue;
        if (!is_titled) {
          const std::string source = fmt::format("{}, {}: ", name, uncertainty_text(one));
          text += (source + one.source).substr(0, 100) + "\n";
        }
        is_titled = true;
        text += line_of(run, one, times);
      }
    }
  }
  return text;
}

}  // namespace diptych::harness
