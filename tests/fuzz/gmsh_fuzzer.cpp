/// Gmsh files, ASCII and binary, 2.2 and 4.1: bytes to a mesh that is sound.

#include "meshes/gmsh.hpp"
#include "meshes/msh/contents.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  return diptych::tests::take_or_refuse(data, size, [](const std::string& bytes) {
    const auto mesh = diptych::meshes::msh::read_msh_bytes(bytes, "fuzz.msh");
    diptych::meshes::check_cells(mesh, "fuzz.msh");
  });
}
