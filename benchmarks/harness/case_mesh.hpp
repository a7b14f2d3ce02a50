#pragma once
/// The mesh of a case at a level, in a numbering that is good for the sweeps.

#include "common/io/field_writer.hpp"
#include "common/run/case.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

struct CaseMesh {
  meshes::Mesh mesh;
  std::vector<std::int32_t> order;  ///< [n_nodes] user's number of each node
};

/// Level L divides the spacing by 2^L.
/// @param work_directory  for what the gmsh program writes
/// @throws base::InputError on a bad mesh, or a level other than 0 of a .msh file
CaseMesh mesh_of(const run::Case& setup, int level, const std::string& work_directory);

/// The mesh in VTK's terms, in the user's numbering.
io::VisualMesh visual_mesh(const CaseMesh& mesh);

}  // namespace diptych::harness
