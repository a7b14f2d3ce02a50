/// Runs a case for the regression: five steps of the canary, level 0, and level 1 where it is
/// affordable.

#include "benchmarks/campaign/campaign.hpp"
#include "benchmarks/convergence/convergence.hpp"
#include "benchmarks/regression/regress.hpp"
#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/judgement.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/provenance.hpp"
#include "benchmarks/run/run_case.hpp"
#include "benchmarks/run/scene.hpp"
#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/run/exact_errors.hpp"
#include "common/run/probes.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace diptych::harness {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// What rounding is relative to: the canary of a field and probes of a unit that are zero but for
/// rounding say nothing relative to themselves. Its length is the spacing of the nodes.
run::NaturalSizes sizes_of_rounding(const cases::Case& setup, const scheme::PairGraph& graph) {
  const double modulus = setup.material.lame + 2 * setup.material.shear_modulus;
  auto sizes = run::natural_sizes(setup, graph, std::sqrt(modulus / setup.material.density));
  sizes.length =
      std::pow(sizes.volume / static_cast<double>(graph.n_nodes()), 1.0 / graph.dimension);
  return sizes;
}

/// Root mean square, and the mean with signs that change from node to node and from component to
/// component: fields with equal norms differ in it.
void add_field(RegressFigures& figures,
               const std::string& name,
               const std::vector<double>& values,
               double natural) {
  double squares = 0, projection = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    squares += values[i] * values[i];
    projection += values[i] * std::cos(1.0 + 0.7 * static_cast<double>(i));
  }
  const double n = static_cast<double>(std::max<size_t>(1, values.size()));
  const double norm = std::sqrt(squares / n);
  const double scale = std::isfinite(norm) ? std::max(norm, natural) : natural;
  figures[name + " norm"] = {norm, scale};
  figures[name + " projection"] = {projection / n, scale};
}

/// Components of a field in the user's numbering of the nodes, row by row.
template <class Value>
std::vector<double> flat(const std::vector<Value>& field, const std::vector<std::int32_t>& order) {
  constexpr int n = Value::SizeAtCompileTime, n_columns = Value::ColsAtCompileTime;
  std::vector<double> values(n * field.size());
  for (size_t a = 0; a < field.size(); ++a)
    for (int k = 0; k < n; ++k)
      values[n * order[a] + k] = field[a](k / n_columns, k % n_columns);
  return values;
}

std::vector<double> flat(const std::vector<double>& field, const std::vector<std::int32_t>& order) {
  std::vector<double> values(field.size());
  for (size_t a = 0; a < field.size(); ++a)
    values[order[a]] = field[a];
  return values;
}

/// Five steps of a stated fraction of the graph's bound, whatever the integrator's default is.
run::NaturalSizes measure_canary(const cases::Case& setup,
                                 const std::string& method,
                                 MethodFigures& figures) {
  const Scene scene(setup, method, 0);
  run::Solver& solver = *scene.solver;
  const std::vector<std::int32_t>& order = scene.mesh.order;
  for (int i = 0; i < 5; ++i) {
    if (solver.time() >= setup.time.end) {
      throw base::InputError(
          fmt::format("{} {}: time.end = {:.6g} s comes after {} steps, the canary makes five; "
                      "take a longer time for the size, such as time.end={:.2g}",
                      setup.name, method, setup.time.end, i, 10 * setup.time.end / i));
    }
    solver.step(setup.time.end);
  }
  const scheme::Snapshot s = solver.snapshot();
  const run::NaturalSizes natural = sizes_of_rounding(setup, scene.graph);
  figures.state = solver.state_hash(order);
  figures.canary["time"] = {s.time, s.time};
  add_field(figures.canary, "displacement", flat(s.u, order), natural.length);
  add_field(figures.canary, "velocity", flat(s.v, order), natural.speed);
  add_field(figures.canary, "F", flat(s.F, order), 1);
  add_field(figures.canary, "H", flat(s.H, order), 1);
  add_field(figures.canary, "J", flat(s.J, order), 1);
  add_field(figures.canary, "stress", flat(s.P, order), natural.stress);
  for (const auto& [name, branches] : {std::pair("A", &s.A), std::pair("S", &s.S)}) {
    for (size_t k = 0; k < branches->size(); ++k) {
      if (!(*branches)[k].empty())
        add_field(figures.canary, fmt::format("{}{}", name, k + 1), flat((*branches)[k], order), 1);
    }
  }
  return natural;
}

/// Below a millionth of it a value is rounding.
double floor_of(const std::string& unit, const run::NaturalSizes& natural, double energy) {
  if (unit == "m") return 1e-6 * natural.length;
  if (unit == "m/s") return 1e-6 * natural.speed;
  if (unit == "Pa") return 1e-6 * natural.stress;
  if (unit == "J" || unit == "J/m") return 1e-6 * energy;
  return 0;
}

constexpr const char* fall_of_viscous = "fall of viscous dissipation";
constexpr const char* fall_of_numerical = "fall of numerical dissipation";

/// Largest decrease of a sum of dissipation between two output times, over the energy.
double fall_of(const RunResult& run, double io::EnergySummary::*dissipation) {
  const std::vector<io::HistoryRow>& history = run.history;
  double fall = 0;
  for (size_t i = 1; i < history.size(); ++i) {
    const double change = history[i].energy.*dissipation - history[i - 1].energy.*dissipation;
    if (!std::isfinite(change)) return std::numeric_limits<double>::quiet_NaN();
    fall = std::max(fall, -change);
  }
  const double scale = run.summary.largest_energy;
  return scale > 0 ? fall / scale : fall;
}

void add_quantities(const RunResult& run,
                    const run::NaturalSizes& natural,
                    RegressFigures& figures) {
  const io::RunSummary& s = run.summary;
  const double energy = s.largest_energy;
  const auto exact = [&](const char* name, std::int64_t n) {
    figures[name] = {static_cast<double>(n), static_cast<double>(n)};
  };
  exact("nodes", s.nodes);
  exact("pairs", s.pairs);
  exact("steps", s.steps);
  figures["end time"] = {s.end_time, s.end_time};
  figures["least J"] = {s.min_jacobian, 1};
  figures["involution H"] = {s.involution_H, 1};
  figures["involution J"] = {s.involution_J, 1};
  // a strain energy is what terms of the size of the modulus leave: it is known to eps times that,
  // and so is the budget
  const double cancelled = std::sqrt(eps) * natural.stress * natural.volume;
  figures["energy residual"] = {s.energy.relative_residual,
                                energy > 0 ? std::max(1.0, cancelled / energy) : 1};
  figures[fall_of_viscous] = {fall_of(run, &io::EnergySummary::viscous_dissipation), 1};
  figures[fall_of_numerical] = {fall_of(run, &io::EnergySummary::numerical_dissipation), 1};
  const auto add_energy = [&](const char* name, double value) {
    figures[name] = {value, std::max(std::abs(value), 1e-6 * energy)};
  };
  add_energy("kinetic energy", s.energy.kinetic);
  figures["strain energy"] = {s.energy.strain,
                              std::max({std::abs(s.energy.strain), 1e-6 * energy, cancelled})};
  add_energy("viscous dissipation", s.energy.viscous_dissipation);
  add_energy("numerical dissipation", s.energy.numerical_dissipation);
  add_energy("external work", s.energy.external_work);
  if (s.energy.projection_work != 0) add_energy("projection work", s.energy.projection_work);
  for (const io::QuantitySummary& q : s.quantities) {
    const double scale =
        std::max({std::abs(q.least), std::abs(q.greatest), floor_of(q.unit, natural, energy)});
    figures[q.name + ", final"] = {q.final_value, scale};
    figures[q.name + ", least"] = {q.least, scale};
    figures[q.name + ", greatest"] = {q.greatest, scale};
    if (q.n_periods > 0) figures[q.name + ", period"] = {q.period, q.period};
  }
}

/// A field of small strains is what terms of the size of the modulus leave: it is known to some eps
/// over the strain, and so are its errors, which are relative to it.
double field_rounding(const run::NaturalSizes& natural, double energy) {
  constexpr double n_terms = 4;
  const double strain = std::sqrt(2 * energy / (natural.stress * natural.volume));
  return strain > 0 ? n_terms * eps / strain : 0;
}

void add_errors(const io::RunSummary& summary, double rounding, RegressFigures& figures) {
  // relative errors below 1e-4 are compared as if they were of that size: an exact field has an
  // error of rounding, which is 1e-15 here and 2e-15 there
  const double least = std::max(1e-4, rounding / std::sqrt(eps));
  const auto add = [&](const std::string& name, double value) {
    figures[name] = {value, std::max(value, least)};
  };
  for (const auto& [field, norms] : summary.errors) {
    add(field + " L1", norms.l1);
    add(field + " L2", norms.l2);
    add(field + " Linf", norms.linf);
  }
}

/// Nothing but tractions and pressures acts on it, all of them known.
bool keeps_momenta(const cases::Case& setup) {
  return !setup.motion &&
         std::all_of(setup.boundaries.begin(), setup.boundaries.end(),
                     [](const auto& b) { return b.type == "traction" || b.type == "pressure"; });
}

std::vector<RegressCheck> conservation_of(const cases::Case& setup, const RunResult& run) {
  const io::RunSummary& s = run.summary;
  const double rounding = eps * static_cast<double>(10 + s.steps);  // one a step
  const std::string name = "conservation";
  std::vector<RegressCheck> checks{
      checked(name, "linear momentum drift", s.linear_momentum_drift, rounding)};
  RegressCheck angular =
      checked(name, "angular momentum drift", s.angular_momentum_drift, rounding);
  if (!keeps_momenta(setup)) {
    angular.verdict = Verdict::skipped;
    angular.note = "the body is supported";
  } else if (!setup.scheme.angular_momentum_projection) {
    angular.verdict = Verdict::skipped;
    angular.note = "without angular_momentum_projection the scheme does not conserve it";
  }
  checks.push_back(angular);
  checks.push_back(checked(name, "energy residual", std::abs(s.energy.relative_residual), 0.02));
  checks.push_back(checked(name, fall_of_viscous,
                           fall_of(run, &io::EnergySummary::viscous_dissipation), rounding));
  RegressCheck numerical = checked(
      name, fall_of_numerical, fall_of(run, &io::EnergySummary::numerical_dissipation), rounding);
  // pair by pair only one limiter gives a sign; else the fall is kept as a quantity
  if (numerical.verdict == Verdict::failed && std::isfinite(numerical.measured) &&
      setup.scheme.limiter != "sign-preserving") {
    numerical.verdict = Verdict::known;
    numerical.note = "limiter " + setup.scheme.limiter + " gives pairs no sign";
  }
  checks.push_back(numerical);
  return checks;
}

/// Overrides with later ones in place of those of the same key.
std::vector<std::string> overriding(const std::vector<std::string>& set,
                                    const std::vector<std::string>& later) {
  const auto key = [](const std::string& entry) { return entry.substr(0, entry.find('=')); };
  std::vector<std::string> result;
  for (const std::string& entry : set) {
    const bool replaced = std::any_of(later.begin(), later.end(), [&](const std::string& other) {
      return key(other) == key(entry);
    });
    if (!replaced) result.push_back(entry);
  }
  result.insert(result.end(), later.begin(), later.end());
  return result;
}

LevelRecord record_of(const cases::Case& setup, const RunResult& run) {
  return {run.summary,
          io::history_columns_from_csv(
              io::history_csv(run.history, run::probe_columns(setup.probes, false)), setup.name)};
}

/// Error bar of level 1, and the value there.
struct BarredValue {
  double value, bar;
};

std::map<std::string, BarredValue> barred(const ColumnConvergence& study,
                                          const std::map<std::string, double>& floors) {
  std::map<std::string, BarredValue> values;
  for (const Quantity& q : study.scalars) {
    const double value = q.values[1];
    const auto floor = floors.find(q.name);
    const double size = std::max(std::abs(value), floor == floors.end() ? 0.0 : floor->second);
    // no figure is known better than the regression keeps it
    values[q.name] = {value, error_bar(study, q, 1) + std::sqrt(eps) * size};
  }
  return values;
}

void add_agreement(const cases::Case& setup,
                   const std::vector<LevelRecord>& records,
                   double energy,
                   const run::NaturalSizes& natural,
                   RegressMeasurement& measurement) {
  std::map<std::string, double> floors{{"min jacobian", 1.0}};
  for (const char* name : {"kinetic energy", "strain energy", "viscous dissipation",
                           "numerical dissipation", "external work", "projection work"})
    floors[name] = energy;
  for (const cases::ProbeCase& probe : setup.probes)
    floors[probe.name] = floor_of(probe.unit, natural, energy);
  const auto studies = convergence_of(records, {});
  std::map<std::string, std::map<std::string, BarredValue>> values;
  for (const ColumnConvergence& study : studies) {
    if (study.levels.size() == 2) values[study.column] = barred(study, floors);
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();  // agrees with no value
  for (const std::string method : {"sph", "fvm"}) {
    for (const auto& [name, value] : values[method])
      measurement.agreement.emplace(name, AgreementFigure{nothing, nothing, 0});
  }
  for (auto& [name, figure] : measurement.agreement) {
    const auto sph = values["sph"].find(name), fvm = values["fvm"].find(name);
    if (sph == values["sph"].end() || fvm == values["fvm"].end()) continue;
    figure = {sph->second.value, fvm->second.value, sph->second.bar + fvm->second.bar};
  }
  if (measurement.agreement.empty()) measurement.no_agreement = "no level 1 of both methods";
}

void add_asked(RegressCheck check, MethodMeasurement& now) {
  if (check.verdict == Verdict::failed && std::isfinite(check.measured))
    now.figures.unmet[check.figure] = check.measured / check.bound;
  now.asked.push_back(std::move(check));
}

/// The bound of [bounds] on level 0.
void ask_dissipation(const cases::Case& setup, const RunResult& run, MethodMeasurement& now) {
  if (!setup.bounds.numerical_dissipation) return;
  add_asked(checked(dissipation_check, "numerical share", numerical_share(run.summary),
                    *setup.bounds.numerical_dissipation),
            now);
}

/// The uncertainties that references state, on the finest level.
void ask_references(const RunResult& run, MethodMeasurement& now) {
  for (const io::ReferenceSummary& one : run.summary.references) {
    if (!one.uncertainty) continue;
    add_asked(checked(reference_check, one.name + ", reference", one.greatest, *one.uncertainty,
                      fmt::format("to {:.4g} s on level {}, {}", one.until, run.summary.level,
                                  one.source)),
              now);
  }
}

RunOptions quiet_options(const std::string& method, int level, int threads) {
  RunOptions options;
  options.method = method;
  options.level = level;
  options.threads = threads;
  options.fields = false;
  options.quiet = true;
  return options;
}

}  // namespace

RegressMeasurement measure_regress(const std::string& case_file,
                                   const RegressBaseline& size,
                                   const std::vector<std::string>& overrides,
                                   int threads) {
  parallel::set_threads(threads);
  const std::vector<std::string> set = overriding(size.set, overrides);
  const cases::Case setup = harness::read_case(case_file, set);
  const cases::Case canary =
      harness::read_case(case_file, overriding(overriding(size.set, {"time.cfl=0.3"}), overrides));
  RegressMeasurement measurement;
  for (const cases::ApartCase& one : setup.apart)
    measurement.explanations[one.quantity] = one.because;
  std::map<std::string, run::NaturalSizes> natural;  // of each method
  std::vector<CampaignRun> plan;
  for (const std::string& method : method_menu().names()) {
    MethodMeasurement& now = measurement.methods[method];
    const auto start = std::chrono::steady_clock::now();
    try {
      natural[method] = measure_canary(canary, method, now.figures);
      for (int level = 0; level < size.levels; ++level)
        plan.push_back({&setup, quiet_options(method, level, threads), method, method});
    } catch (const base::BreakdownError& error) {
      now.failure = error.what();
    } catch (const base::Interruption&) {
      return measurement;  // while a mesh was made
    }
    now.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  std::vector<LevelRecord> records;
  double energy = 0;
  const auto add = [&](size_t, const CampaignResult& made, const Schedule&) {
    const RunResult& run = made.run;
    const io::RunSummary& s = run.summary;
    MethodMeasurement& now = measurement.methods[s.method];
    now.seconds += s.wall_seconds;
    if (s.status == "breakdown") {
      if (now.failure.empty()) now.failure = breakdown_message(s);
      return;
    }
    if (!cut_short({s}).empty()) {
      if (now.failure.empty()) {
        now.failure = cut_short_message(s) + "; the size of a case is its time.end";
        now.failure_code = base::ExitCode::wrong_input;
      }
      return;
    }
    records.push_back(record_of(setup, run));
    if (s.level + 1 == size.levels) ask_references(run, now);
    if (s.level > 0) return;
    const double rounding = field_rounding(natural[s.method], s.largest_energy);
    add_errors(s, rounding, now.figures.errors);
    add_quantities(run, natural[s.method], now.figures.quantities);
    now.conservation = conservation_of(setup, run);
    ask_dissipation(setup, run, now);
    energy = std::max(energy, s.largest_energy);
  };
  if (!make_runs(plan, TakeOver::nothing, add)) return measurement;
  if (size.levels < 2) {
    measurement.no_agreement = "one level only: " + size.one_level_because;
  } else {
    add_agreement(setup, records, energy, natural[method_menu().names().back()], measurement);
  }
  return measurement;
}

}  // namespace diptych::harness
