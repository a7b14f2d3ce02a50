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

/// Whether the reconstruction is symmetric where operators leave jumps whose sign is not known
/// (Operators::loses_sign): asked for, or by "auto".
bool takes_symmetric_jumps(const cases::SchemeCase& scheme);

}  // namespace diptych::harness
