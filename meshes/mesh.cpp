#include "meshes/mesh.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"

namespace diptych::meshes {

int n_nodes_of(CellType type) {
  constexpr int n_nodes[] = {3, 4, 4, 8, 6};  // in the order of CellType
  return n_nodes[static_cast<size_t>(type)];
}

int dimension_of(CellType type) {
  return type == CellType::triangle || type == CellType::quadrilateral ? 2 : 3;
}

const BoundaryGroup& Mesh::group(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& candidate : boundary_groups) {
    if (candidate.name == name) return candidate;
    names.push_back(candidate.name);
  }
  if (names.empty()) {
    throw base::InputError("the mesh has no boundary group '" + name +
                           "': it has none at all; name its sides (Gmsh: Physical " +
                           (dimension == 3 ? "Surface" : "Curve") + ")");
  }
  throw base::InputError("the mesh has no boundary group '" + name + "'" +
                         base::suggestion(name, names));
}

}  // namespace diptych::meshes
