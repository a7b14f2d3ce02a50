#pragma once
/// The boundary group that a case names, in the graph of its mesh.

#include "common/cases/case.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <string>

namespace diptych::run {

/// @throws base::InputError where the mesh has no group of that name: the nearest one, or that it
///         has none
const scheme::BoundaryPatch& boundary_group(const scheme::PairGraph& graph,
                                            const std::string& name,
                                            const functions::SourcePlace& where);

}  // namespace diptych::run
