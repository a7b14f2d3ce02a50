#include "benchmarks/run/wall_directions.hpp"

#include "common/base/error.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "meshes/shape_integrals.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace diptych::harness {

namespace {

/// How many faces of the groups look along a direction, and against it.
struct Looking {
  size_t n_along = 0, n_against = 0;
};

Looking looking(const std::vector<std::string>& groups,
                const algebra::Vec3& normal,
                const meshes::Mesh& mesh) {
  constexpr double slant = 1e-6;
  Looking result;
  for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
    if (std::find(groups.begin(), groups.end(), group.name) == groups.end()) continue;
    for (const std::int32_t f : group.faces) {
      const algebra::Vec3 area = face_area(mesh.boundary_faces[static_cast<size_t>(f)], mesh.nodes);
      const double cosine = area.dot(normal) / (area.norm() * normal.norm());
      if (cosine > slant) ++result.n_along;
      if (cosine < -slant) ++result.n_against;
    }
  }
  return result;
}

}  // namespace

void require_walls_before_sides(const cases::Case& setup, const meshes::Mesh& mesh) {
  if (!setup.initial.displacement.is_zero()) return;
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    if (scheme::boundary_menu().at(boundary.type).acts != scheme::BoundaryKind::Acts::touch)
      continue;
    const algebra::Vec3& n = boundary.normal;
    const Looking faces = looking(boundary.groups, n, mesh);
    if (faces.n_along == 0 || faces.n_against > 0) continue;
    throw base::InputError(fmt::format(
        "{}no face of {} looks against the normal ({:g}, {:g}, {:g}) of its rigid wall, which the "
        "body would pass: the normal must point towards the body, as ({:g}, {:g}, {:g}) does",
        functions::prefix(boundary.where), fmt::join(boundary.groups, ", "), n[0], n[1], n[2],
        0.0 - n[0], 0.0 - n[1], 0.0 - n[2]));
  }
}

}  // namespace diptych::harness
