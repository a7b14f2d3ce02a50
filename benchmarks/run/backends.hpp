#pragma once
/// The methods: factories of pair graphs. Adding one: its room and a line in backends.cpp.

#include "common/base/registry.hpp"
#include "common/cases/case.hpp"
#include "common/scheme/graph/operators.hpp"
#include "meshes/mesh.hpp"

namespace diptych::harness {

using GraphMaker = scheme::Operators (*)(const meshes::Mesh& mesh, const cases::Case& setup);

/// sph, fvm: what each makes of a mesh for a case.
const base::Registry<GraphMaker>& method_menu();

}  // namespace diptych::harness
