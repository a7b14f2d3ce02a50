#pragma once
/// Frames of the field output: what they hold at every node, and the observer that writes them at
/// the output times. Test: tests/common/run/fields_test.cpp

#include "common/io/field_writer.hpp"
#include "common/run/observers/history.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::run {

/// Displacement, velocity, deformation gradient, first Piola-Kirchhoff and Cauchy stress (nine
/// components each, row by row), von Mises stress, J, pressure, node by node of the snapshot. Plane
/// strain gives all components.
std::vector<io::NodeField> frame_fields(const Snapshot& state);

class Fields : public Observer {
 public:
  /// Writes nothing yet.
  /// @param order    [node] its number in the user's mesh, which frames have; kept by reference
  /// @param columns  headers of the probes, whose values stand in each frame
  /// @param history  has them; kept by reference, told of an output before this one
  Fields(const std::vector<std::int32_t>& order,
         std::vector<std::string> columns,
         const History& history);

  /// From now on frames are written, behind those of before a checkpoint.
  /// @param writer  made with frame_times()
  void write_with(io::FieldWriter writer);
  /// Of the frames that were written  [s]
  const std::vector<double>& frame_times() const { return times_; }

  void at_output(const Output& output) override;
  void at_breakdown(const Output& output) override { at_output(output); }
  void archive(algebra::Archive& archive) override { archive.reals("frames/times", "s", times_); }
  /// Path of the last frame and its time [s]; empty before the first.
  const io::FrameEntry& last_frame() const { return last_frame_; }

 private:
  std::optional<io::FieldWriter> writer_;
  const std::vector<std::int32_t>& order_;
  std::vector<std::int32_t> nodes_;  ///< in the user's order; empty where nothing is written
  std::vector<std::string> columns_;
  const History& history_;
  std::vector<double> times_;
  io::FrameEntry last_frame_;
};

}  // namespace diptych::run
