/// What the levels of a table say of the values on an infinitely fine mesh, and whether the methods
/// agree there.

#include "benchmarks/verifier/verification.hpp"
#include "postprocess/report/grid_convergence.hpp"
#include "postprocess/report/orders.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A column of one sequence on its three finest levels.
struct Estimate {
  double finest = nothing;
  report::GridConvergence convergence;
};

std::optional<Estimate> estimate_of(const VerificationSequence& sequence, size_t column) {
  const size_t n = sequence.rows.size();
  if (n < 3) return std::nullopt;
  double h[3], f[3];
  for (size_t i = 0; i < 3; ++i) {
    const VerificationRow& row = sequence.rows[n - 1 - i];
    h[i] = row.summary.spacing;
    f[i] = row.value[column];
    if (!row.failure.empty() || !std::isfinite(f[i])) return std::nullopt;
  }
  if (!(h[0] < h[1] && h[1] < h[2])) return std::nullopt;
  return Estimate{f[0], report::grid_convergence(h, f)};
}

/// Five digits: more than an error bar of a per mille leaves.
std::string value_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.5g}", value) : "-";
}

std::vector<std::string> line_of(const std::string& method, const Estimate& e) {
  const report::GridConvergence& c = e.convergence;
  return {
      report::method_title(method),
      value_text(e.finest),
      fmt::format("{:.2g}", c.error_bar),
      std::isfinite(c.index) ? fmt::format("{:.2g} %", 100 * c.index) : "-",
      std::isfinite(c.order) ? fmt::format("{:.2f}", c.order) : report::convergence_name(c.kind),
      value_text(c.extrapolated)};
}

/// "yes, 0.3 of the bars"
std::string agreement(const Estimate& a, const Estimate& b) {
  const double difference = std::abs(a.finest - b.finest);
  const double bars = a.convergence.error_bar + b.convergence.error_bar;
  if (difference == 0) return "yes";
  return fmt::format("{}, {:.2g} of the bars", difference <= bars ? "yes" : "**no**",
                     difference / bars);
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
