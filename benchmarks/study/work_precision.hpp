#pragma once
/// Work-precision: what error costs. A curve is one method on one variant of a case over levels;
/// seconds are of the time loop without output, least and most of the repetitions. Between levels
/// errors and costs are interpolated along straight lines in log-log; nothing is extrapolated.
/// Test: tests/harness/work_precision_test.cpp

#include "benchmarks/probes/machine_probes.hpp"
#include "common/io/run_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

struct WorkPoint {
  io::RunSummary run;          ///< of the fastest repetition
  double least = 0, most = 0;  ///< s
  double face_correction = 0;  ///< kappa_f of the case
  double pair_updates() const {
    return static_cast<double>(run.pairs) * static_cast<double>(run.stages);
  }
  double error(const std::string& field) const;  ///< relative L2, NaN where not measured
};

struct WorkCurve {
  std::string variant, method;
  std::vector<WorkPoint> points;  ///< coarse to fine
  std::string name() const;       ///< "SPH", "FVM kappa=1.2"
};

/// An interval of seconds or of errors; NaN where the curve does not reach.
struct Range {
  double least, most;
};

Range cost_at_error(const WorkCurve& curve, const std::string& field, double error);
Range error_at_cost(const WorkCurve& curve, const std::string& field, double seconds);

/// Where two curves meet: below that error the other one is cheaper.
struct Crossover {
  double error, seconds;
};
std::optional<Crossover> crossover(const WorkCurve& a,
                                   const WorkCurve& b,
                                   const std::string& field);

/// n values from least to most in equal ratios, over what all curves reach; empty where nothing is
/// common. @param cost  seconds instead of errors
std::vector<double> common_values(const std::vector<WorkCurve>& curves,
                                  const std::string& field,
                                  bool cost,
                                  int n);

/// Levels of every curve, costs at equal error and errors at equal cost, crossovers.
std::string work_precision_table(const std::vector<WorkCurve>& curves,
                                 const std::string& field,
                                 const probes::MachineProbes& machine);
std::string work_precision_csv(const std::vector<WorkCurve>& curves);

/// What the curves say, in plain words and HTML.
std::string work_precision_verdict(const std::vector<WorkCurve>& curves, const std::string& field);

/// One page with the plots and the tables, nothing beside it.
std::string work_precision_html(const std::string& title,
                                const std::vector<WorkCurve>& curves,
                                const std::string& field,
                                const probes::MachineProbes& machine);

}  // namespace diptych::harness
