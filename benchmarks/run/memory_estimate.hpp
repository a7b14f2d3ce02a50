#pragma once
/// What a run will ask of the machine, from the case alone, before anything is built.
/// Test: tests/harness/memory_estimate_test.cpp, within 30 % of what `diptych check` measures.

#include "common/cases/case.hpp"
#include "meshes/mesh.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::harness {

/// Doubles, as what is asked may be beyond any integer.
struct MemoryEstimate {
  double nodes = 0, cells = 0, pairs = 0;
  double bytes = 0;  ///< largest resident set above that of the bare program: while building
};

/// Of a box at a level. @pre the case names no mesh file
MemoryEstimate estimate_memory(const cases::Case& setup, const std::string& method, int level);
/// Of a mesh that stands.
MemoryEstimate estimate_memory(const cases::Case& setup,
                               const std::string& method,
                               const meshes::Mesh& mesh);

/// Refuses what cannot be, before the first of the runs begins. Cases with a mesh file are passed
/// over, but for their levels: how many nodes gmsh will make is not known.
/// @throws base::InputError for levels that no machine has; base::EnvironmentError where a run asks
///         for more memory than there is, with both numbers
void require_memory(const cases::Case& setup,
                    const std::vector<std::string>& methods,
                    const std::vector<int>& levels);
/// The same once the mesh stands, for one from a file.
void require_memory(const cases::Case& setup,
                    const std::string& method,
                    int level,
                    const meshes::Mesh& mesh);

/// "3.4 kB", "12 MB", "2.9 TB"
std::string bytes_text(double bytes);

}  // namespace diptych::harness
