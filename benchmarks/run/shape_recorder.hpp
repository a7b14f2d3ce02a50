#pragma once
/// Takes the deformed surface of a run at some of its output times, for the pictures of a report.

#include "benchmarks/run/case_mesh.hpp"
#include "common/run/observers/observer.hpp"
#include "postprocess/report/shapes.hpp"

namespace diptych::harness {

/// Boundary faces in 3-D, cells in 2-D; nodes in ascending order.
report::Surface surface_of(const meshes::Mesh& mesh);

class ShapeRecorder : public run::Observer {
 public:
  /// @param n_outputs  output times of the run, t = 0 included
  ShapeRecorder(const meshes::Mesh& mesh, size_t n_outputs);

  void at_output(const run::Output& output) override;
  const report::ShapeRecord& record() const { return record_; }

 private:
  report::ShapeRecord record_;
  std::vector<algebra::Vec3> X_;  ///< [points] m
  size_t n_outputs_, stride_;
};

}  // namespace diptych::harness
