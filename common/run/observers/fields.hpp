#pragma once
/// Frames of the field output: what they hold at every node, and the observer that writes them at
/// the output times. Test: tests/common/run/fields_test.cpp

#include "common/io/field_writer.hpp"
#include "common/run/observers/history.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::run {

/// Displacement, velocity, deformation gradient, first Piola-Kirchhoff and Cauchy stress (nine
/// components each, row by row), von Mises stress, J, pressure. Plane strain gives all components.
/// @param order  [node] its number in the user's mesh, which the fields have
std::vector<io::NodeField> frame_fields(const Snapshot& state,
                                        const std::vector<std::int32_t>& order);

class Fields : public Observer {
 public:
  /// @param writer   of the folder, with the mesh in the user's numbering
  /// @param order    [node] its number there; kept by reference
  /// @param columns  headers of the probes, whose values stand in each frame
  /// @param history  has them; kept by reference, told of an output before this one
  Fields(io::FieldWriter writer,
         const std::vector<std::int32_t>& order,
         std::vector<std::string> columns,
         const History& history);

  void at_output(const Output& output) override;
  void at_breakdown(const Output& output) override { at_output(output); }
  /// Path of the last frame and its time [s]; empty before the first.
  const io::FrameEntry& last_frame() const { return last_frame_; }

 private:
  io::FieldWriter writer_;
  const std::vector<std::int32_t>& order_;
  std::vector<std::string> columns_;
  const History& history_;
  io::FrameEntry last_frame_;
};

}  // namespace diptych::run
