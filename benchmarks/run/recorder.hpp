#pragma once
/// What is taken down of a run at its output times: history, probes, frames, shapes, errors,
/// drifts of the momenta, least volume of the cells. Test: tests/command_line/verbs_test.cpp

#include "benchmarks/run/energy_record.hpp"
#include "benchmarks/run/exact_record.hpp"
#include "benchmarks/run/run_case.hpp"
#include "benchmarks/run/run_log.hpp"
#include "benchmarks/run/shape_recorder.hpp"
#include "common/io/field_writer.hpp"
#include "common/run/exact_errors.hpp"
#include "common/run/probes.hpp"
#include "meshes/deformed_cells.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

/// Writes, counts and measures at the output times of a run.
class Recorder {
 public:
  /// @param setup, options, solver, result  kept by reference
  Recorder(const cases::Case& setup,
           const RunOptions& options,
           const CaseMesh& mesh,
           run::Solver& solver,
           RunResult& result);

  /// Makes the files that grow with the run, where the run has a folder.
  /// @throws base::EnvironmentError
  void open(const CaseMesh& mesh);
  /// At an output time.
  void record(const run::StepReport& step);
  /// After every step.
  void record_step(const run::StepReport& step);
  /// No more rows will come: those that were written are on the disk.
  void finish();
  /// What the run comes to. @pre record() has been called
  void fill(io::RunSummary& summary) const;

  const std::map<std::string, std::vector<double>>& errors() const { return errors_.nodal(); }
  double energy_residual();

 private:
  io::HistoryRow row_of(const run::StepReport& step, const scheme::Balance& balance);
  void raise_scales(const std::map<std::string, double>& norms);
  void update_drifts(const scheme::Balance& now, const scheme::Audit& audit);
  void check_cells(const scheme::Snapshot& state);
  void write_frame(const scheme::Snapshot& state);

  const cases::Case& setup_;
  const RunOptions& options_;
  run::Solver& solver_;
  RunResult& result_;
  run::ExactErrors errors_;
  run::Probes probes_;
  ExactRecord exact_;
  scheme::Balance initial_;
  EnergyRecord energy_;
  meshes::DeformedCells cells_;
  std::unique_ptr<RunLog> log_;
  std::unique_ptr<io::FieldWriter> writer_;
  std::unique_ptr<ShapeRecorder> shapes_;
  double momentum_scale_ = 0, angular_scale_ = 0, linear_drift_ = 0, angular_drift_ = 0;
  double least_cell_J_ = 1e300;
  std::int64_t most_inverted_cells_ = 0;
  std::optional<double> inverted_from_;
};

}  // namespace diptych::harness
