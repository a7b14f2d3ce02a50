#pragma once
/// What the exact solution of a case gives at the output times of a run, for exact.csv and the
/// report: kinetic energy and linear momentum by the nodal volumes of the run, and the probes whose
/// fields it has. Test: tests/harness/exact_record_test.cpp

#include "common/io/run_record.hpp"
#include "common/run/probes.hpp"

#include <vector>

namespace diptych::harness {

class ExactRecord {
 public:
  /// @param setup, graph, probes  kept by reference
  ExactRecord(const cases::Case& setup, const scheme::PairGraph& graph, const run::Probes& probes)
      : setup_(setup), graph_(graph), probes_(probes) {}

  /// @param exact  fields at every node at an output time; the same ones each time
  void take(const scheme::Snapshot& exact);
  /// Time first, the names and units of history.csv, without momenta that are zero throughout;
  /// empty where nothing was taken.
  std::vector<io::HistoryColumn> columns() const;

 private:
  const cases::Case& setup_;
  const scheme::PairGraph& graph_;
  const run::Probes& probes_;
  std::vector<io::HistoryColumn> columns_;
  double momentum_scale_ = 0;  ///< kg m/s, largest sum of |p| over the nodes
};

}  // namespace diptych::harness
