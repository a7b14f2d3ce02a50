#include "benchmarks/cost/stability.hpp"

#include "benchmarks/run/interruption.hpp"
#include "benchmarks/terminal/text.hpp"
#include "common/base/error.hpp"
#include "common/run/default_cfl.hpp"
#include "common/run/solver.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

constexpr double noise = 1e-8;           // of c_p: strains of that size stay linear
constexpr double greatest_growth = 1e4;  // since the start: the answer is clear
constexpr double allowed_growth = 3;     // between the second and the last quarter
constexpr int sampling = 5;              // steps between two measurements

/// |S_ab| of every directed pair.
std::vector<double> pair_areas(const scheme::PairGraph& graph) {
  std::vector<double> area(graph.C.size());
  for (size_t k = 0; k < area.size(); ++k)
    area[k] = 0.5 * (graph.C[k] - graph.C[graph.reverse(k)]).norm();
  return area;
}

double roughness(const scheme::PairGraph& graph,
                 const std::vector<double>& area,
                 const scheme::Snapshot& first,
                 const scheme::Snapshot& second) {
  double sum = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const algebra::Vec3 own = second.v[a] - first.v[a];
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
      const std::int32_t b = graph.neighbour[k];
      sum += area[k] * (second.v[b] - first.v[b] - own).squaredNorm();
    }
  }
  return std::sqrt(0.5 * sum);
}

/// The case and its disturbed twin, step by step with the same time steps.
class Twins {
 public:
  Twins(cases::Case setup, const scheme::PairGraph& graph)
      : far_(1e6 * setup.time.end), graph_(graph), area_(pair_areas(graph)) {
    setup.time.max_retries = 0;  // the step that is tried, not half of it
    cases::Case disturbed = setup;
    const cases::MaterialCase& m = setup.material;
    disturbed.initial.velocity_noise =
        noise * std::sqrt((m.lame + 2 * m.shear_modulus) / m.density);
    // its own bound differs by the noise; it takes the steps of the first
    disturbed.time.cfl *= 1.001;
    first_ = run::make_solver(setup, graph);
    second_ = run::make_solver(disturbed, graph);
  }

  /// @return dt; sets apart() where the second could not follow
  double step() {
    const double dt = first_->step(far_).dt;
    second_->step(first_->time());
    apart_ = second_->time() != first_->time();
    return dt;
  }
  bool apart() const { return apart_; }
  double difference() const {
    return roughness(graph_, area_, first_->snapshot(), second_->snapshot());
  }

 private:
  double far_;
  const scheme::PairGraph& graph_;
  std::vector<double> area_;
  std::unique_ptr<run::Solver> first_, second_;
  bool apart_ = false;
};

}  // namespace

StabilityTrial try_step(const cases::Case& setup,
                        const scheme::PairGraph& graph,
                        const StabilityOptions& options) {
  StabilityTrial trial;
  const int n = options.n_steps;
  try {
    Twins twins(setup, graph);
    const double start = twins.difference();
    double second_quarter = 0, last_quarter = 0;
    for (int i = 1; i <= n && !interrupt_requested(); ++i) {
      const double dt = twins.step();
      if (i == 1) trial.dt = dt;
      if (i % sampling != 0 && !twins.apart()) continue;
      const double R = twins.difference();
      if (!(R <= greatest_growth * start) || twins.apart()) {
        trial.growth = R / start;
        return trial;
      }
      if (4 * i > n && 2 * i <= n) second_quarter = std::max(second_quarter, R);
      if (4 * i > 3 * n) last_quarter = std::max(last_quarter, R);
    }
    trial.growth = last_quarter / second_quarter;
    trial.stable = trial.growth <= allowed_growth;
  } catch (const base::BreakdownError& error) {
    trial.growth = greatest_growth;
    trial.breakdown = error.what();
  }
  return trial;
}

StabilityLimit stability_limit(
    cases::Case setup,
    const scheme::PairGraph& graph,
    const std::string& integrator,
    const StabilityOptions& options,
    const std::function<void(double cfl, const StabilityTrial& trial)>& each) {
  StabilityLimit result;
  result.integrator = integrator;
  result.nodes = graph.n_nodes();
  result.default_cfl = run::default_cfl(setup, graph, time::integrator_menu().at(integrator));
  setup.time.integrator = integrator;
  const auto stable = [&](double cfl) {
    setup.time.cfl = cfl;
    const StabilityTrial trial = try_step(setup, graph, options);
    if (!interrupt_requested()) each(cfl, trial);
    if (trial.stable) result.dt = trial.dt;
    result.why = trial.breakdown;
    return trial.stable;
  };
  const double least = result.default_cfl / 64, most = 64 * result.default_cfl;
  double below = 0, above = result.default_cfl;
  if (stable(above)) {
    do {
      below = above;
      above *= 1.5;
    } while (above < most && !interrupt_requested() && stable(above));
  } else {
    double next = above / 1.5;
    while (next > least && !interrupt_requested() && !stable(next)) {
      above = next;
      next /= 1.5;
    }
    if (next <= least) {
      if (result.why.empty()) result.why = fmt::format("grows at every cfl down to {:.3g}", above);
      return result;
    }
    below = next;
  }
  while (above / below > 1 + options.precision && !interrupt_requested()) {
    const double middle = std::sqrt(below * above);
    (stable(middle) ? below : above) = middle;
  }
  result.why.clear();
  result.limit = interrupt_requested() ? 0 : below;
  return result;
}

std::string stability_table(const std::vector<StabilityLimit>& limits) {
  size_t width = 7;
  for (const StabilityLimit& row : limits)
    width = std::max(width, row.variant.size());
  const std::string head = fmt::format("{:<{}}  {:<6}  {:<10}  {:>7}  {:>7}  {:>12}  {:>7}  {:>13}",
                                       "variant", width, "method", "integrator", "nodes", "limit",
                                       "dt limit [s]", "default", "default/limit");
  std::string text = head + "\n" + std::string(head.size(), '-') + "\n";
  for (const StabilityLimit& row : limits) {
    text +=
        fmt::format("{:<{}}  {:<6}  {:<10}  {:>7}  ", row.variant.empty() ? "as is" : row.variant,
                    width, row.method, row.integrator, row.nodes);
    if (row.limit > 0) {
      text += fmt::format("{:>7.3f}  {:>12.3e}  {:>7.2f}  {:>13.2f}{}\n", row.limit, row.dt,
                          row.default_cfl, row.ratio(), row.ratio() > 1 ? "  UNSTABLE" : "");
    } else {
      text += fmt::format("none: {}\n", row.why);
    }
  }
  return text;
}

std::string stability_csv(const std::vector<StabilityLimit>& limits) {
  std::string csv =
      "variant,method,integrator,nodes,limit [-],dt at limit [s],default [-],default/limit [-]\n";
  for (const StabilityLimit& row : limits) {
    csv += fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", quoted(row.variant), row.method,
                       row.integrator, row.nodes, row.limit, row.dt, row.default_cfl, row.ratio());
  }
  return csv;
}

}  // namespace diptych::harness
