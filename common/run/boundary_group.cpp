#include "common/run/boundary_group.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "meshes/united_groups.hpp"

#include <vector>

namespace diptych::run {

const scheme::BoundaryPatch& boundary_group(const scheme::PairGraph& graph,
                                            const std::string& name,
                                            const functions::SourcePlace& where) {
  std::vector<std::string> names;
  for (const auto& patch : graph.patches) {
    if (patch.name == name) return patch;
    names.push_back(patch.name);
  }
  throw base::InputError(functions::prefix(where) + "the mesh has no boundary group '" + name +
                         "'" +
                         (names.empty() ? std::string("; it has none: name its physical groups")
                                        : base::suggestion(name, names)));
}

std::vector<const scheme::BoundaryPatch*> patches_with_each_face_once(
    const scheme::PairGraph& graph,
    const std::vector<std::string>& names,
    const functions::SourcePlace& where) {
  std::vector<const scheme::BoundaryPatch*> patches;
  for (const std::string& name : names)
    patches.push_back(&boundary_group(graph, name, where));
  const std::string united = meshes::united_name(names);
  for (const scheme::BoundaryPatch& patch : graph.patches)
    if (patch.name == united) patches = {&patch};
  return patches;
}

}  // namespace diptych::run
