#pragma once
/// The mesh of a case at a level, in a numbering that is good for the sweeps.

#include "common/cases/case.hpp"
#include "common/io/field_writer.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

struct CaseMesh {
  meshes::Mesh mesh;
  std::vector<std::int32_t> order;  ///< [n_nodes] user's number of each node
};

/// Of any case; memory ends far below.
inline constexpr int greatest_level = 20;
/// @throws base::InputError for a level below 0 or above the greatest
void check_level(int level);
/// Of n levels from `first` on, the same; the message names --levels.
void check_levels(int first, int n);

/// Level L divides the spacing by 2^L.
/// @param work_directory  where the gmsh program gets a new folder, which is removed; empty: the
///                        system's folder for temporary files, looked for only where it is needed
/// @throws base::InputError on a bad mesh, or a level other than 0 of a .msh file;
///         base::EnvironmentError where no folder can be made
CaseMesh mesh_of(const cases::Case& setup, int level, const std::string& work_directory = "");

/// The mesh in VTK's terms, in the user's numbering.
io::VisualMesh visual_mesh(const CaseMesh& mesh);

}  // namespace diptych::harness
