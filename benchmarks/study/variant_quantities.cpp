#include "benchmarks/study/variant_quantities.hpp"

#include "benchmarks/terminal/text.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The probe of "tip displacement, period"; the name itself where it is of no probe.
std::string probe_of(const std::string& name) {
  return name.substr(0, name.rfind(", "));
}

/// What every run has, whatever its case, and what it took.
std::vector<RunQuantity> quantities_and_cost(const WorkPoint& point) {
  std::vector<RunQuantity> all = common_quantities(point.run);
  all.insert(all.end() - 2, {"seconds", "s", point.least});  // before the counts
  return all;
}

/// Names that --quantity may give, without those of whole probes.
std::vector<std::string> names_of_case(const cases::Case& setup) {
  std::vector<std::string> names;
  for (const cases::ProbeCase& probe : setup.probes) {
    io::QuantitySummary empty;
    empty.name = probe.name;
    for (const RunQuantity& q : quantities_of_probe(empty)) {
      const bool of_oscillation = q.name.ends_with(", period") || q.name.ends_with(", amplitude");
      if (probe.oscillation || !of_oscillation) names.push_back(q.name);
    }
  }
  for (const RunQuantity& q : quantities_and_cost({}))
    names.push_back(q.name);
  return names;
}

bool is_shown_by_default(const std::string& name, const StudyRuns& runs) {
  if (name == "steps" || name == "nodes") return false;
  bool any = false, any_not_zero = false;
  for (const WorkCurve& curve : runs.curves) {
    for (const WorkPoint& point : curve.points) {
      const double value = value_of(point, name);
      any = any || std::isfinite(value);
      any_not_zero = any_not_zero || (std::isfinite(value) && value != 0);
    }
  }
  const bool is_energy =
      name.ends_with(" energy") || name.ends_with(" dissipation") || name.ends_with(" work");
  return any && (any_not_zero || !is_energy);
}

}  // namespace

std::vector<RunQuantity> quantities_of_run(const WorkPoint& point) {
  std::vector<RunQuantity> all;
  for (const io::QuantitySummary& probe : point.run.quantities) {
    for (const RunQuantity& q : quantities_of_probe(probe))
      all.push_back(q);
  }
  for (const RunQuantity& q : quantities_and_cost(point))
    all.push_back(q);
  return all;
}

double value_of(const WorkPoint& point, const std::string& quantity) {
  for (const RunQuantity& q : quantities_of_run(point)) {
    if (q.name == quantity) return q.value;
  }
  return nothing;
}

void check_quantities(const cases::Case& setup, const std::vector<std::string>& wanted) {
  std::vector<std::string> known = names_of_case(setup);
  for (const cases::ProbeCase& probe : setup.probes)
    known.push_back(probe.name);
  known.emplace_back("all");
  for (const std::string& name : wanted) {
    if (!contains(known, name)) {
      throw base::InputError("--quantity '" + name + "' is none of " + setup.name +
                             base::suggestion(name, known));
    }
  }
}

std::vector<std::string> chosen_quantities(const cases::Case& setup,
                                           const std::vector<std::string>& wanted,
                                           const StudyRuns& runs) {
  std::vector<std::string> chosen;
  for (const std::string& name : names_of_case(setup)) {
    const bool is_chosen = wanted.empty() ? is_shown_by_default(name, runs)
                                          : contains(wanted, "all") || contains(wanted, name) ||
                                                contains(wanted, probe_of(name));
    if (is_chosen) chosen.push_back(name);
  }
  return chosen;
}

}  // namespace diptych::harness
