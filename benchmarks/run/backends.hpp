#pragma once
/// The methods: factories of pair graphs. Adding one: its room and a line in backends.cpp.

#include "common/base/registry.hpp"
#include "common/cases/case.hpp"
#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

using GraphMaker = scheme::PairGraph (*)(const meshes::Mesh& mesh, const cases::Case& setup);

/// sph, fvm
const base::Registry<GraphMaker>& method_menu();

/// What a method makes of this mesh, where the case alone does not say it.
struct GraphDescription {
  std::string operators;             ///< for the record, or empty
  std::vector<std::string> notices;  ///< where it is less than the case asks for
};

GraphDescription graph_description(const std::string& method,
                                   const meshes::Mesh& mesh,
                                   const cases::Case& setup);

}  // namespace diptych::harness
