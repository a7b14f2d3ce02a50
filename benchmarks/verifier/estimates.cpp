/// What the levels of a table say of the values on an infinitely fine mesh, and whether the methods
/// agree there.

#include "benchmarks/terminal/text.hpp"
#include "benchmarks/verifier/verification.hpp"
#include "postprocess/report/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// A column of one sequence on its three finest levels.
struct Estimate {
  std::string method;
  double finest = 0, scale = 0;  ///< scale: its largest size on any level
  report::FormalOrder formal_order;
  report::GridConvergence convergence;
};

std::optional<Estimate> estimate_of(const VerificationSequence& sequence, size_t column) {
  std::vector<double> spacings, values;
  double scale = 0;
  for (const VerificationRow& row : sequence.rows) {
    spacings.push_back(row.summary.spacing);
    values.push_back(row.value[column]);
    scale = std::max(scale, std::abs(row.value[column]));
  }
  const auto convergence = report::finest_convergence(spacings, values);
  if (!convergence) return std::nullopt;
  return Estimate{sequence.method, values.back(), scale,
                  report::formal_order(sequence.rows.back().summary), *convergence};
}

/// Five digits: more than an error bar of a per mille leaves.
constexpr const char* value_format = "{:.5g}";

std::vector<std::string> line_of(const std::string& method, const Estimate& e) {
  const report::GridConvergence& c = e.convergence;
  return {report::method_title(method),
          number_text(e.finest, value_format),
          fmt::format("{:.2g}", c.error_bar),
          number_text(100 * c.index, "{:.2g} %"),
          number_text(c.order, "{:.2f}", report::convergence_name(c.kind)),
          number_text(c.extrapolated, value_format)};
}

/// "yes, 0.3 of the bars"; a verdict needs that both methods resolve the value.
std::string agreement(const Estimate& a, const Estimate& b) {
  const auto side = [](const Estimate& one) {
    return report::ScalarOfMethod{one.method == "fvm" ? "FVM" : "SPH", one.finest,
                                  one.convergence.error_bar, one.convergence, one.formal_order};
  };
  const report::Verdict verdict = report::verdict_on(side(a), side(b), std::max(a.scale, b.scale));
  const bool is_apart = verdict.agreement == report::Agreement::apart;
  if (!is_apart && verdict.agreement != report::Agreement::agree)
    return report::verdict_text(verdict);
  if (!is_apart && verdict.difference > verdict.allowed) return "yes, in six digits";
  if (verdict.difference == 0) return "yes";
  return fmt::format("{}, {:.2g} of the bars", is_apart ? "**no**" : "yes",
                     verdict.difference / verdict.allowed);
}

}  // namespace

std::string estimates_section(const VerificationResult& result, size_t r) {
  std::vector<std::vector<std::string>> lines{{"quantity", "literature", "method", "finest level",
                                               "error bar", "GCI", "order", "extrapolated",
                                               "agree"}};
  for (size_t c = 0; c < result.table.columns.size(); ++c) {
    const VerificationColumn& column = result.table.columns[c];
    if (!column.estimate) continue;
    std::vector<Estimate> known;
    const size_t first = lines.size();
    for (const VerificationSequence& sequence : result.sequences) {
      if (sequence.run != r) continue;
      const auto found = estimate_of(sequence, c);
      if (!found) continue;
      std::vector<std::string> line = line_of(sequence.method, *found);
      const bool is_first = lines.size() == first;
      line.insert(line.begin(), {is_first ? column.title : "", is_first ? column.literature : ""});
      line.push_back("");
      lines.push_back(line);
      known.push_back(*found);
    }
    if (known.size() == 2) lines.back().back() = agreement(known[0], known[1]);
  }
  if (lines.size() == 1) return "";
  return "\nExtrapolated from the three finest levels:\n\n" + markdown_table(lines, 3);
}

}  // namespace diptych::harness
