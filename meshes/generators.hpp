#pragma once
/// Meshes made here: a box of one cell type.

#include "common/base/registry.hpp"
#include "meshes/mesh.hpp"

#include <array>
#include <cstdint>

namespace diptych::meshes {

/// The cells that case files may ask for, by name: hexahedron, tetrahedron, ...
const base::Registry<CellType>& cell_menu();

/// A box [lower, upper] divided into cells[0] x cells[1] (x cells[2]) blocks; each block is one
/// hexahedron (quadrilateral), two prisms or six tetrahedra (two triangles), of equal orientation
/// in all blocks so that the mesh conforms. Boundary groups: x_min, x_max, y_min, y_max (z_min,
/// z_max). Nodes in x-fastest order. The third components have no meaning in 2-D and are not read.
/// @throws base::InputError on cells < 1, lower >= upper, too many nodes for 32-bit indices
Mesh box(CellType type, const Vec3& lower, const Vec3& upper, const std::array<int, 3>& cells);

/// Moves interior nodes by a uniform random vector of at most `fraction` of the least edge length
/// at the node in each direction (same seed, same mesh, on every machine). Shifts that fold a cell
/// are drawn again.
/// @throws base::InputError on a negative fraction, or one so large that cells fold in every draw
void perturb_interior(Mesh& mesh, double fraction, std::uint64_t seed);

}  // namespace diptych::meshes
