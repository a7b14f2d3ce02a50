/// What the regression compares and how. A comparison is met only by finite numbers within a bound.

#include "benchmarks/regression/regress.hpp"
#include "benchmarks/run/provenance.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {

namespace {

const double sqrt_eps = std::sqrt(std::numeric_limits<double>::epsilon());
/// Five steps where the processor, the compiler or its flags differ: rounding of some 1e-16 a step
/// grows by the factors of a wave across a few cells.
constexpr double canary_elsewhere = 1e-9, canary_here = 1e-13;

/// Of a recorded scale over that of the run: a wider one would let more pass than is said.
constexpr double scale_growth = 1.001;

/// Growth of a known disagreement that is only rounding.
constexpr double known_growth = 1e-6;

void append(std::vector<RegressCheck>& to, const std::vector<RegressCheck>& checks) {
  to.insert(to.end(), checks.begin(), checks.end());
}

/// What is asked of a method against what was not met when it was recorded.
std::vector<RegressCheck> asked_checks(const MethodFigures& recorded,
                                       const MethodMeasurement& now) {
  std::vector<RegressCheck> checks = now.asked;
  for (RegressCheck& check : checks) {
    const auto known = recorded.unmet.find(check.figure);
    if (check.verdict != Verdict::failed || known == recorded.unmet.end()) continue;
    if (!std::isfinite(check.measured)) continue;
    if (check.measured <= check.bound * known->second * (1 + known_growth)) {
      check.verdict = Verdict::known;
    } else {
      check.note += fmt::format("{}not met when it was recorded, by less: {:.4g} times the bound",
                                check.note.empty() ? "" : "; ", known->second);
    }
  }
  for (const auto& [name, excess] : recorded.unmet) {
    const bool is_measured = std::any_of(checks.begin(), checks.end(),
                                         [&](const auto& one) { return one.figure == name; });
    if (!is_measured)
      checks.push_back(failure(reference_check, name, "was recorded as not met, is not measured"));
  }
  return checks;
}

}  // namespace

double AgreementFigure::excess() const {
  const double difference = std::abs(sph - fvm);
  if (difference == 0) return 0;  // also where the bars have no width
  return difference / bars;
}

bool RegressPlatform::operator==(const RegressPlatform& other) const {
  return instruction_set == other.instruction_set && compiler == other.compiler &&
         flags == other.flags;
}

RegressPlatform this_platform() {
  const io::Provenance p = provenance("");
  return {p.instruction_set, p.compiler, p.flags};
}

RegressCheck failure(const std::string& name,
                     const std::string& figure,
                     const std::string& note,
                     base::ExitCode code) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  return {name, figure, Verdict::failed, nothing, nothing, note, code};
}

RegressCheck checked(const std::string& name,
                     const std::string& figure,
                     double measured,
                     double bound,
                     const std::string& note) {
  const bool met = std::isfinite(measured) && std::isfinite(bound) && measured <= bound;
  return {name, figure, met ? Verdict::met : Verdict::failed, measured, bound, note};
}

std::vector<RegressCheck> compare_figures(const std::string& check,
                                          const RegressFigures& recorded,
                                          const RegressFigures& now,
                                          double relative_bound) {
  std::vector<RegressCheck> checks;
  for (const auto& [name, old] : recorded) {
    const auto found = now.find(name);
    if (found == now.end()) {
      checks.push_back(failure(check, name, "was recorded, is not measured"));
      continue;
    }
    const double change = std::abs(found->second.value - old.value);
    // the scale of the record: a figure must not widen its own bound
    const double relative = change == 0 ? 0 : change / old.scale;
    checks.push_back(checked(check, name, relative, relative_bound,
                             fmt::format("{:.9g}, was {:.9g}", found->second.value, old.value)));
    // nor may the record
    if (checks.back().verdict == Verdict::met && old.scale > scale_growth * found->second.scale) {
      checks.back() = failure(check, name,
                              fmt::format("was recorded with the scale {:.4g}, which its bound is "
                                          "relative to; the run itself gives {:.4g}",
                                          old.scale, found->second.scale));
    }
  }
  for (const auto& [name, figure] : now) {
    if (recorded.count(name) == 0)
      checks.push_back(failure(check, name, "is measured, was not recorded"));
  }
  return checks;
}

std::vector<RegressCheck> checks_of(const MethodFigures& recorded,
                                    const MethodMeasurement& now,
                                    bool same_platform) {
  if (!now.failure.empty()) {
    const bool is_breakdown = now.failure_code == base::ExitCode::breakdown;
    return {failure("run", is_breakdown ? "breakdown" : "end", now.failure, now.failure_code)};
  }
  std::vector<RegressCheck> checks;
  if (recorded.canary.empty() || recorded.quantities.empty())
    checks.push_back(failure("canary", "record", "the baseline is empty"));
  append(checks, compare_figures("canary", recorded.canary, now.figures.canary,
                                 same_platform ? canary_here : canary_elsewhere));
  if (same_platform && recorded.state != now.figures.state) {
    checks.push_back({"canary", "bits of the state", Verdict::skipped, 0, 0,
                      "they differ, which the norms above judge"});
  }
  append(checks, compare_figures("errors", recorded.errors, now.figures.errors, sqrt_eps));
  append(checks,
         compare_figures("quantities", recorded.quantities, now.figures.quantities, sqrt_eps));
  append(checks, now.conservation);
  append(checks, asked_checks(recorded, now));
  return checks;
}

std::vector<RegressCheck> agreement_checks(const RegressBaseline& recorded,
                                           const RegressMeasurement& now) {
  if (!now.no_agreement.empty())
    return {{"agreement", "", Verdict::skipped, 0, 0, now.no_agreement}};
  std::vector<RegressCheck> checks;
  for (const auto& [name, figure] : now.agreement) {
    const std::string note = fmt::format("sph {:.6g}, fvm {:.6g}", figure.sph, figure.fvm);
    RegressCheck check = checked("agreement", name, figure.excess(), 1, note);
    const auto known = recorded.disagreement.find(name);
    if (check.verdict == Verdict::failed && known != recorded.disagreement.end()) {
      check = checked("agreement", name, figure.excess(), known->second * (1 + known_growth), note);
      if (check.verdict == Verdict::met) {
        check = {check.name, name, Verdict::known, check.measured, 1, note};
        const auto why = now.explanations.find(name);
        check.note += why != now.explanations.end()
                          ? "; " + why->second
                          : "; the case does not say why: add [[apart]] with the measured cause";
      }
    }
    checks.push_back(check);
  }
  for (const auto& [name, excess] : recorded.disagreement) {
    if (now.agreement.count(name) == 0)
      checks.push_back(failure("agreement", name, "was recorded, is not measured"));
  }
  return checks;
}

}  // namespace diptych::harness
