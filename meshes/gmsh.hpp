#pragma once
/// Gmsh input: a bounded reader of .msh files (4.1 and 2.2, ASCII and binary) and the call of the
/// gmsh program for .geo files.

#include <string>

#include "meshes/mesh.hpp"

namespace diptych::meshes {

/// Reads cells of the highest dimension present, boundary faces, and physical groups of the
/// boundary dimension as boundary groups. Nodes that no cell uses are dropped.
/// @throws base::InputError "path: ..." (or path:line) on malformed, truncated or unsupported
///         input, an inverted or degenerate cell (its number and place), second-order elements,
///         NaN coordinates, counts that the file cannot hold
Mesh read_msh(const std::string& path);

/// Meshes a .geo file with the gmsh program (Delaunay, one thread, repeatable) into
/// `work_directory` and reads the result. `size` is passed as the parameter h.
/// @throws base::EnvironmentError where gmsh is not installed (names the Debian package) or fails
Mesh mesh_geo(const std::string& geo_path, int dimension, double size,
              const std::string& work_directory);

/// Checks all cells (positive Jacobian at every corner, finite coordinates, no repeated node).
/// @throws base::InputError naming the first bad cell and its place
void check_cells(const Mesh& mesh, const std::string& name);

/// Fills mesh.boundary_faces (outward) from the cells; returns nothing else. Used by all makers.
/// @throws base::InputError on a face shared by more than two cells
void find_boundary_faces(Mesh& mesh);

}  // namespace diptych::meshes
