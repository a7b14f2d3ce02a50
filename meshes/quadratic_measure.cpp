#include "meshes/quadratic_measure.hpp"

#include "common/base/error.hpp"
#include "meshes/moment_balance.hpp"
#include "meshes/quadratic_volumes.hpp"
#include "meshes/side_areas.hpp"
#include "meshes/surface.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::meshes {

namespace {

/// Part of the largest moment by which moments of volumes and areas may differ.
constexpr double most_difference = 1e-9;
/// The same, over the number of nodes at the boundary, once they have been balanced: nodes that
/// stand nearly in three lines cannot be told more of cubics, and what is left is far less than an
/// adjoint may miss (common/closure/summation_by_parts.hpp).
constexpr double most_left = 0.1;
/// Part of a volume or an area by which it may change so that they do not differ: where sides are
/// curved, and where they are plane and have few nodes across.
constexpr double most_change[] = {0.05, 0.3};
/// Part of the nodes that are inside, where volumes and areas do not agree at once: bodies one cell
/// thick have none, and rows that leave the wall nothing to hold it.
constexpr double least_inside = 0.05;

void set_patches(const Mesh& mesh, const std::vector<FaceArea>& faces, DualMeasure& measure) {
  std::vector<Vec3> total(mesh.nodes.size(), Vec3::Zero());
  for (size_t g = 0; g < measure.patches.size(); ++g) {
    PatchArea& patch = measure.patches[g];
    for (const std::int32_t f : mesh.boundary_groups[g].faces)
      add_areas(faces[f], total);
    for (size_t i = 0; i < patch.nodes.size(); ++i) {
      patch.area[i] = total[patch.nodes[i]];
      total[patch.nodes[i]].setZero();
    }
  }
}

void require_small(double change, double most) {
  if (change <= most) return;
  throw base::InputError(fmt::format(
      "the mesh is too coarse for operators that sum by parts: volumes or areas of nodes would "
      "change by {:.2g} of themselves, bound {:.2g}, to agree about moments of cubics: refine it "
      "where it has fewer than four nodes along a line or bends by much from face to face",
      change, most));
}

void require_inner_nodes(const std::vector<Vec3>& boundary_area) {
  const auto n = static_cast<double>(boundary_area.size());
  const auto inside = static_cast<double>(std::count_if(boundary_area.begin(), boundary_area.end(),
                                                        [](const Vec3& A) { return A.isZero(0); }));
  if (inside >= least_inside * n) return;
  throw base::InputError(fmt::format(
      "{:.2g} of the nodes are inside the body, operators that sum by parts ask for {:.2g}: its "
      "walls are hardly more than one cell thick: refine the mesh",
      inside / n, least_inside));
}

/// Loads on them would not be whole.
void require_whole_groups(double difference) {
  if (difference <= most_difference) return;
  throw base::InputError(fmt::format(
      "areas of boundary groups would change by {:.2g} of themselves for operators that sum by "
      "parts: a group has too few faces: refine the mesh there",
      difference));
}

void require_agreement(double difference, const std::vector<Vec3>& boundary_area) {
  const auto n_boundary = static_cast<double>(std::count_if(
      boundary_area.begin(), boundary_area.end(), [](const Vec3& A) { return !A.isZero(0); }));
  if (difference <= std::max(most_difference, most_left / n_boundary)) return;
  throw base::InputError(fmt::format(
      "volumes and areas of this mesh differ by {:.2g} in the moments of cubics, which operators "
      "that sum by parts do not bear: refine the mesh",
      difference));
}

void require_positive(const Mesh& mesh, const std::vector<double>& Omega) {
  for (size_t a = 0; a < Omega.size(); ++a) {
    if (Omega[a] > 0) continue;
    const Vec3& X = mesh.nodes[a];
    throw base::InputError(fmt::format(
        "node {} at ({:.6g}, {:.6g}, {:.6g}) would have the volume {:.3g} by a rule that is exact "
        "for quadratics: the mesh is too coarse there, or its cells change in size too "
        "fast: refine it, or grade it more gently",
        a, X[0], X[1], X[2], Omega[a]));
  }
}

}  // namespace

DualMeasure quadratic_measure(const Mesh& mesh) {
  DualMeasure measure = dual_measure(mesh, Quadrature::exact);  // and its checks of the mesh
  const Surface surface(mesh);
  std::vector<FaceArea> faces = side_areas(mesh, surface, Faces::plane);
  measure.boundary_area = areas_of_nodes(faces, mesh.nodes.size());
  const bool agrees =
      moment_difference_of_facets(mesh, surface, measure.boundary_area) <= most_difference;
  if (!agrees) require_inner_nodes(measure.boundary_area);
  const bool is_curved = !agrees && surface.has_curved_faces();
  const Faces kind = is_curved ? Faces::smooth : Faces::plane;
  if (is_curved) faces = side_areas(mesh, surface, kind);
  measure.Omega = quadratic_volumes(mesh, measure.Omega, is_curved ? &surface : nullptr);
  require_positive(mesh, measure.Omega);
  // plane sides agree, too, where their nodes tell cubics apart
  if (!agrees || moment_difference(mesh, measure.Omega, measure.boundary_area) > most_difference) {
    const double most = most_change[is_curved ? 0 : 1];
    require_small(balance_moments(mesh, surface, kind, most, faces, measure.Omega), most);
    require_whole_groups(group_difference(mesh, surface, kind, faces));
    measure.boundary_area = areas_of_nodes(faces, mesh.nodes.size());
  }
  require_agreement(moment_difference(mesh, measure.Omega, measure.boundary_area),
                    measure.boundary_area);
  set_patches(mesh, faces, measure);
  return measure;
}

}  // namespace diptych::meshes
