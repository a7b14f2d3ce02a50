#include "common/scheme/graph/equal_widths.hpp"

#include "common/base/error.hpp"
#include "meshes/cell_widths.hpp"
#include "meshes/structured_block.hpp"

#include <optional>

namespace diptych::scheme {

namespace {

bool is_long(const Mat3& shape) {
  constexpr double least_aspect = 1.1;
  return meshes::aspect_of(shape) >= least_aspect;
}

/// Areas of nodes X as those of nodes B X, det B = 1.
void stretch(const Mat3& B, PairGraph& graph) {
  const Mat3 cofactor = B.inverse().transpose();
  const auto change = [&](Vec3& area) { area = cofactor * area; };
  const auto apply = [&](std::vector<Vec3>& areas) {
    for (Vec3& area : areas)
      change(area);
  };
  apply(graph.boundary_area);
  for (BoundaryPatch& patch : graph.patches)
    apply(patch.area);
  graph.C.change_alike(change);
}

std::optional<PairGraph> of_stretched(const meshes::Mesh& mesh,
                                      const Mat3& B,
                                      const GraphFactory& make) {
  meshes::Mesh stretched = mesh;
  for (Vec3& X : stretched.nodes)
    X = B * X;
  try {
    return make(stretched);
  } catch (const base::InputError&) {
    return std::nullopt;
  }
}

}  // namespace

bool has_long_cells(const meshes::Mesh& mesh) {
  return is_long(meshes::mean_shape(mesh));
}

bool has_long_cells_off_boxes(const meshes::Mesh& mesh) {
  return !meshes::is_undistorted_block(mesh) && has_long_cells(mesh);
}

PairGraph on_equal_widths(const meshes::Mesh& mesh, const GraphFactory& make) {
  const Mat3 shape = meshes::mean_shape(mesh);
  if (!is_long(shape)) return make(mesh);
  const Mat3 B = meshes::to_equal_widths(shape);
  std::optional<PairGraph> graph = of_stretched(mesh, B, make);
  if (!graph) return make(mesh);
  stretch(B.inverse(), *graph);
  graph->X = mesh.nodes;
  validate(*graph);
  return *std::move(graph);
}

}  // namespace diptych::scheme
