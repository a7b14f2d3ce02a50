#pragma once
/// The methods: factories of pair graphs. Adding one: its room and a line in backends.cpp.

#include "common/base/registry.hpp"
#include "common/run/case.hpp"
#include "common/scheme/pair_graph.hpp"
#include "meshes/mesh.hpp"

namespace diptych::harness {

using GraphMaker = scheme::PairGraph (*)(const meshes::Mesh& mesh, const run::Case& setup);

/// sph, fvm
const base::Registry<GraphMaker>& method_menu();

}  // namespace diptych::harness
