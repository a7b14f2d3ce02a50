#pragma once
/// The run against the exact solution of its case at the output times: error norms, and what the
/// exact solution gives for exact.csv and the report: kinetic energy and linear momentum by the
/// nodal volumes of the run, and the probes whose fields it has.
/// Test: tests/harness/exact_record_test.cpp

#include "common/io/run_record.hpp"
#include "common/run/exact_errors.hpp"
#include "common/run/observers/observer.hpp"
#include "common/run/probes.hpp"

#include <vector>

namespace diptych::run {

class ExactComparison : public Observer {
 public:
  /// @param setup, graph, solver, probes  kept by reference
  ExactComparison(const cases::Case& setup,
                  const scheme::PairGraph& graph,
                  const Solver& solver,
                  const Probes& probes)
      : setup_(setup), graph_(graph), probes_(probes), errors_(setup, graph, solver) {}

  /// Does nothing where the case has no exact solution.
  void at_output(const Output& output) override;
  void archive(algebra::Archive& archive) override;

  const ExactErrors& errors() const { return errors_; }
  /// Time first, the names and units of history.csv, without momenta that are zero throughout;
  /// empty where the case has no exact solution.
  std::vector<io::HistoryColumn> columns() const;

 private:
  void add_row(const Snapshot& exact);

  const cases::Case& setup_;
  const scheme::PairGraph& graph_;
  const Probes& probes_;
  ExactErrors errors_;
  std::vector<io::HistoryColumn> columns_;
  double momentum_scale_ = 0;  ///< kg m/s, largest sum of |p| over the nodes
};

}  // namespace diptych::run
