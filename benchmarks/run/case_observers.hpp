#pragma once
/// The observers of a run of the harness: those that every run has, and those that its options ask
/// for. Test: tests/command_line/verbs_test.cpp

#include "benchmarks/run/progress_observer.hpp"
#include "benchmarks/run/run_case.hpp"
#include "benchmarks/run/scene.hpp"
#include "benchmarks/run/shape_recorder.hpp"
#include "benchmarks/run/sliding_watch.hpp"
#include "benchmarks/run/wall_watch.hpp"
#include "common/run/observers/cell_guard.hpp"
#include "common/run/observers/cell_watch.hpp"
#include "common/run/observers/cells.hpp"
#include "common/run/observers/energy_guard.hpp"
#include "common/run/observers/exact_comparison.hpp"
#include "common/run/observers/field_scales.hpp"
#include "common/run/observers/fields.hpp"
#include "common/run/observers/history.hpp"
#include "common/run/observers/involution_guard.hpp"
#include "common/run/observers/momentum_guard.hpp"
#include "common/run/observers/step_probes.hpp"
#include "common/run/observers/volume_guard.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

/// Of a mesh that outlives this; nothing is made before something asks.
run::MeshAround mesh_around(const meshes::Mesh& mesh);

class CaseObservers {
 public:
  /// Writes nothing yet.
  /// @param setup, options, scene  kept by reference
  /// @param spacing  of the nodes  [m]
  /// @throws base::InputError on a probe that has no place in the body
  CaseObservers(const cases::Case& setup,
                const RunOptions& options,
                const Scene& scene,
                double spacing);

  /// Where it goes on from a checkpoint, which has been loaded: what it needs of the files that it
  /// has written before is there. @throws base::InputError where it is not
  void check_files() const;
  /// Makes the files that grow with the run, where it has a folder. @throws base::EnvironmentError
  void open();
  /// In the order in which they are to be told.
  std::vector<run::Observer*> all();
  /// J, what rounding makes of the energies of the body (run::EnergyUnits).
  double energy_rounding() const { return rounding_; }
  /// Of the outputs so far.
  const std::vector<io::HistoryRow>& rows() const { return history_.rows(); }
  /// What is to be told of walls that the body went through.
  std::optional<std::string> notice_of_walls() const { return walls_.notice(); }
  std::optional<std::string> notice_of_cells() const { return cells_.notice(); }
  std::optional<std::string> notice_of_sliding() const { return sliding_.notice(); }
  /// What is to be told of the exact solution: that the run begins with another motion, or that
  /// some of its fields are zero.
  std::optional<std::string> notice_of_exact() const;
  /// What is to be told of volumes that carry the pressure, where J of nodes has left them.
  std::optional<std::string> notice_of_volumes() const { return volume_guard_.notice(); }
  /// Path and time [s] of the last frame of fields; an empty path where there is none.
  io::FrameEntry last_frame() const { return fields_.last_frame(); }
  /// Moves what was taken down, and what it comes to for the summary, into the result.
  void give(RunResult& result);

 private:
  run::CellOutlook look(double dt) const;

  const cases::Case& setup_;
  const RunOptions& options_;
  const Scene& scene_;
  run::Probes probes_;
  std::int64_t n_cells_;
  run::Cells cells_;
  run::EnergyUnits units_;
  double rounding_;  // J, of the body as it begins
  run::History history_;
  run::StepProbes steps_;
  run::ExactComparison exact_;
  run::Fields fields_;
  ProgressObserver progress_;
  WallWatch walls_;
  SlidingWatch sliding_;
  std::optional<run::FieldScales> scales_;
  std::optional<ShapeRecorder> shapes_;
  std::optional<run::CellWatch> cell_watch_;
  std::optional<run::CellGuard> cell_guard_;
  run::EnergyGuard energy_guard_;
  run::InvolutionGuard involution_guard_;
  run::MomentumGuard momentum_guard_;
  run::VolumeGuard volume_guard_;
};

}  // namespace diptych::harness
