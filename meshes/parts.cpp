#include "meshes/parts.hpp"

#include "meshes/joined.hpp"

namespace diptych::meshes {

std::int64_t n_parts(const Mesh& mesh) {
  Joined nodes(mesh.n_nodes());
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto corners = mesh.cell(c);
    for (const std::int32_t a : corners)
      nodes.join(corners[0], a);
  }
  std::int64_t n = 0;
  for (std::int32_t a = 0; a < mesh.n_nodes(); ++a)
    n += nodes.of(a) == a ? 1 : 0;
  return n;
}

}  // namespace diptych::meshes
