#pragma once
/// The boundary groups that a case names, in the graph of its mesh.

#include "common/cases/case.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <string>
#include <vector>

namespace diptych::run {

/// @throws base::InputError where the mesh has no group of that name: the nearest one, or that it
///         has none
const scheme::BoundaryPatch& boundary_group(const scheme::PairGraph& graph,
                                            const std::string& name,
                                            const functions::SourcePlace& where);

/// Patches that have each face of these groups once: the groups, or, where two of them have faces
/// in common, the one that unites them (meshes/united_groups.hpp).  @throws as above
std::vector<const scheme::BoundaryPatch*> patches_with_each_face_once(
    const scheme::PairGraph& graph,
    const std::vector<std::string>& names,
    const functions::SourcePlace& where);

}  // namespace diptych::run
