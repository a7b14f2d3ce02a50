#pragma once
/// Cells of a deformed mesh: what neither method's state can see. A nodal F is a mean over
/// neighbours, so every nodal J can be positive while a cell between the nodes has turned inside
/// out, and with it the body has passed through itself. Test: tests/meshes/deformed_cells_test.cpp

#include "meshes/mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych::meshes {

/// Signed volume of the cell (2-D: area, per unit thickness) with its nodes at x: the integral of
/// the Jacobian of its shape functions, exact for every first-order cell; negative where most of it
/// is inside out.
/// @param x  [n_nodes of the mesh] m
double signed_volume(const Mesh& mesh, std::int64_t cell, std::span<const Vec3> x);

/// Least Jacobian of the cell's corners (as cell_checks.hpp has it) with its nodes at x, m^3 or
/// m^2: not above 0 where the cell is folded there, whatever the sign of its volume.
double least_corner_jacobian(const Mesh& mesh, std::int64_t cell, std::span<const Vec3> x);

/// Of all cells, the deformed volume over the volume in the mesh: the mean J of a cell.
class DeformedCells {
 public:
  /// @param mesh  kept by reference; of sound cells (check_cells)
  explicit DeformedCells(const Mesh& mesh);

  struct Least {
    double J = 1;                 ///< least ratio of all cells; NaN where a displacement is
    std::int64_t n_inverted = 0;  ///< cells with a ratio <= 0
    std::int64_t cell = 0;        ///< that with the least ratio, the first one of NaN
    std::int64_t n_folded = 0;    ///< cells with a ratio > 0 that have a corner inside out
    std::int64_t folded = -1;     ///< the first of them
  };
  struct Outlook {
    Least now;
    double steps_left = 0;  ///< least J/(J - J of the next step); infinite where none gets smaller
  };
  /// And in how many steps the first cell would come to nothing if each lost in all of them what it
  /// loses in the next one.
  /// @param u  [n_nodes] displacements, m  @param v  [n_nodes] velocities, m/s; may be empty
  /// @param dt  s
  Outlook outlook(std::span<const Vec3> u, std::span<const Vec3> v, double dt) const;

 private:
  const Mesh& mesh_;
  std::vector<double> volume_;  // [n_cells] m^3 (m^2 in 2-D)
};

}  // namespace diptych::meshes
