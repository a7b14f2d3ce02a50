#include "postprocess/report/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::report {

namespace {

std::string formal_text(const FormalOrder& order) {
  return order.least == order.greatest ? fmt::format("{:g}", order.greatest)
                                       : fmt::format("{:g} to {:g}", order.least, order.greatest);
}

/// What a method lacks to be resolved, as it stands behind its name; empty where nothing is.
std::string why_unresolved(const ScalarOfMethod& one, double scale) {
  const auto& estimate = one.estimate;
  if (!estimate) return "has fewer than three levels";
  if (estimate->kind == Convergence::same) return "";
  if (estimate->kind != Convergence::monotone) return convergence_name(estimate->kind);
  const bool has_order = estimate->order >= one.formal_order.least - order_tolerance &&
                         estimate->order <= one.formal_order.greatest + order_tolerance;
  if (!has_order) {
    return fmt::format("shows order {:.2g} (its own is {})", estimate->order,
                       formal_text(one.formal_order));
  }
  const double index = estimate->error_bar / scale;
  if (!(index <= largest_index)) return fmt::format("has an error bar of {:.2g} %", 100 * index);
  return "";
}

bool equal_in_six_digits(double a, double b) {
  return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b));
}

}  // namespace

Verdict verdict_on(const ScalarOfMethod& a, const ScalarOfMethod& b, double scale) {
  Verdict verdict;
  verdict.difference = std::abs(a.value - b.value);
  verdict.allowed = a.error_bar + b.error_bar;
  const std::string why_a = why_unresolved(a, scale), why_b = why_unresolved(b, scale);
  if (!why_a.empty() && why_a == why_b) {
    verdict.why = "each method " + why_a;
  } else {
    if (!why_a.empty()) verdict.why = a.method + " " + why_a;
    if (!why_b.empty()) verdict.why += (verdict.why.empty() ? "" : "; ") + b.method + " " + why_b;
  }
  const auto is_within = [&] {
    return verdict.difference <= verdict.allowed || equal_in_six_digits(a.value, b.value);
  };
  if (verdict.why.empty()) {
    verdict.agreement = is_within() ? Agreement::agree : Agreement::apart;
    return verdict;
  }
  if (!a.estimate || !b.estimate) return verdict;
  const double bar_a = 3 * a.estimate->range, bar_b = 3 * b.estimate->range;
  if (!(std::max(bar_a, bar_b) <= largest_index * scale)) return verdict;
  verdict.allowed = bar_a + bar_b;
  verdict.agreement = is_within() ? Agreement::near : Agreement::far;
  return verdict;
}

std::string verdict_text(const Verdict& verdict) {
  switch (verdict.agreement) {
    case Agreement::agree:
      return "agree";
    case Agreement::apart:
      return "APART";
    case Agreement::near:
      return "unresolved, near: " + verdict.why;
    case Agreement::far:
      return "unresolved, far: " + verdict.why;
    default:
      return "unresolved: " + verdict.why;
  }
}

}  // namespace diptych::report
