#pragma once
/// Gmsh input: a bounded reader of .msh files (4.1 and 2.2, ASCII and binary) and the call of the
/// gmsh program for .geo files.

#include "meshes/mesh.hpp"

#include <string>

namespace diptych::meshes {

/// Reads cells of the highest dimension present, boundary faces, and physical groups of the
/// boundary dimension as boundary groups (named by their tag where they have no name). Nodes are
/// ordered by their tags; those that no cell uses are dropped, and so are groups of other
/// dimensions. Where every cell is inverted, which is a convention (a plane seen from below), all
/// are turned around; cells of both orientations are an error. Pyramids, partitioned meshes, faces
/// of a group inside the mesh, groups without faces and hanging nodes are errors too.
/// @throws base::InputError "path: ..." (or path:line) on malformed, truncated or unsupported
///         input, an inverted or degenerate cell (its number and place), second-order elements,
///         NaN coordinates, counts that the file cannot hold
Mesh read_msh(const std::string& path);

/// Meshes a .geo file with the gmsh program (Delaunay, one thread, repeatable) into
/// `work_directory` and reads the result. `size` is passed as the parameter h: a .geo file takes it
/// up with `DefineConstant[ h = 0.1 ];`.
/// @throws base::InputError where the file is missing, runs, writes or reads what it may not
///         (geo_scan.hpp), has a mistake of syntax, or gives a bad mesh
/// @throws base::EnvironmentError where gmsh is not installed (names the Debian package) or fails
Mesh mesh_geo(const std::string& geo_path,
              int dimension,
              double size,
              const std::string& work_directory);

/// Whether mesh_geo has a gmsh program to start.
bool has_gmsh();

/// Checks all cells (positive Jacobian at every corner, finite coordinates, no repeated node).
/// @throws base::InputError naming the first bad cell and its place
void check_cells(const Mesh& mesh, const std::string& name);

/// Cells that a mesh may have: a face is counted by its cell and its place there, in 32 bits.
inline constexpr std::int64_t most_cells = 536'870'911;

/// Fills mesh.boundary_faces (outward) from the cells; returns nothing else. Used by all makers.
/// @throws base::InputError on a face shared by more than two cells, or more than most_cells
void find_boundary_faces(Mesh& mesh);

/// Corners of the faces of a group, outward; -1 where a face has fewer than four.
std::vector<std::array<std::int32_t, 4>> corners_of(const Mesh& mesh, const BoundaryGroup& group);

}  // namespace diptych::meshes
