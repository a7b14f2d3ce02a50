#pragma once
/// `diptych study CASE --stability`: the largest stable time step of a case, found by bisection, in
/// terms of its factor on the graph bound (time.cfl).
///
/// Stable means: a small disturbance does not grow. Each trial runs the case twice in step, once
/// as it is and once with random velocities of 1e-8 c_p added at the start, which excite every mode
/// of the graph. The difference dv of the two runs, measured between neighbours so that the slow
/// smooth motion of the body does not count,
///   R = (1/2 sum_a sum_b |S_ab| |dv_b - dv_a|^2)^(1/2),
/// must not grow: a trial is unstable where its largest R over the last quarter of the steps is
/// more than three times that of the second quarter, where R has passed 1e4 times its start, or
/// where a run breaks down. Growth in proportion to time (two bodies drifting apart) stays below
/// two. What grows by less than 3^(2/n) - 1 a step, 0.22 % with n = 1000, is not seen.
/// Test: tests/harness/stability_test.cpp, against von Neumann limits.

#include "common/cases/case.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <functional>
#include <string>
#include <vector>

namespace diptych::harness {

struct StabilityOptions {
  int n_steps = 1000;
  double precision = 0.01;  ///< of the limit, relative
};

/// One trial of one time step.
struct StabilityTrial {
  bool stable = false;
  double growth = 0;  ///< R of the last quarter / R of the second, or as far as it came
  double dt = 0;      ///< s, of the first step
  std::string breakdown;
};

/// @param setup  its integrator and cfl are those of the trial
StabilityTrial try_step(const cases::Case& setup,
                        const scheme::PairGraph& graph,
                        const StabilityOptions& options);

/// Largest stable cfl of a case with an integrator.
struct StabilityLimit {
  std::string variant, method, integrator;
  std::int64_t nodes = 0;
  double limit = 0;        ///< 0: none found, `why` says what happened
  double default_cfl = 0;  ///< of the integrator on this graph
  double dt = 0;           ///< s, first step at the limit
  std::string why;
  double ratio() const { return limit > 0 ? default_cfl / limit : 0; }
};

/// @param each  called after every trial with the cfl tried
StabilityLimit stability_limit(
    cases::Case setup,
    const scheme::PairGraph& graph,
    const std::string& integrator,
    const StabilityOptions& options,
    const std::function<void(double cfl, const StabilityTrial& trial)>& each);

/// Table for the terminal, at most 100 columns.
std::string stability_table(const std::vector<StabilityLimit>& limits);
std::string stability_csv(const std::vector<StabilityLimit>& limits);

}  // namespace diptych::harness
