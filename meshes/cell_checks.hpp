#pragma once
/// What can be wrong with a cell, told apart so that readers can name it in their own numbers.

#include "meshes/mesh.hpp"

#include <cstdint>
#include <string>

namespace diptych::meshes {

enum class CellFault : std::uint8_t {
  none,
  node_out_of_range,
  not_finite,  ///< a coordinate, or so large that the Jacobian overflows
  repeated_node,
  degenerate,  ///< nodes that coincide or lie in a line or plane
  reversed,    ///< all corner Jacobians negative: a mirrored node order
  folded       ///< corner Jacobians of either sign: re-entrant or twisted
};

/// Corner Jacobians (edge vectors at a corner) are compared with the product of the edge lengths:
/// a corner of relative volume below this is no corner in double precision, and far below any
/// sliver that a mesher makes (a dihedral angle of 0.1 degrees gives about 1e-3).
inline constexpr double least_relative_jacobian = 1e-12;

CellFault fault_of(const Mesh& mesh, std::int64_t cell);

/// "is degenerate: its nodes lie in one plane", ... to follow the cell's name in a message.
std::string description(CellFault fault, int dimension);

/// Mean of the cell's nodes (of those in range), for messages.
Vec3 centre_of(const Mesh& mesh, std::int64_t cell);

}  // namespace diptych::meshes
