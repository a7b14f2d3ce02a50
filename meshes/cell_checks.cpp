#include "meshes/cell_checks.hpp"

#include "common/base/error.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/corner_jacobian.hpp"
#include "meshes/gmsh.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::meshes {

namespace {

CellFault node_fault(const Mesh& mesh, std::span<const std::int32_t> nodes) {
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] < 0 || nodes[i] >= mesh.n_nodes()) return CellFault::node_out_of_range;
    if (!mesh.nodes[nodes[i]].allFinite()) return CellFault::not_finite;
    for (size_t j = 0; j < i; ++j) {
      if (nodes[i] == nodes[j]) return CellFault::repeated_node;
    }
  }
  return CellFault::none;
}

/// Jacobian at a corner and the product of its edge lengths.
std::pair<double, double> jacobian_and_scale(const Mesh& mesh,
                                             std::span<const std::int32_t> nodes,
                                             const LocalCorner& corner) {
  const Vec3& origin = mesh.nodes[nodes[corner.node]];
  const auto edge = [&](int k) -> Vec3 { return mesh.nodes[nodes[corner.neighbours[k]]] - origin; };
  const bool is_plane = mesh.dimension == 2;
  const Vec3 a = edge(0), b = edge(1), c = is_plane ? Vec3::UnitZ() : edge(2);
  return {corner_jacobian(is_plane, a, b, c), a.norm() * b.norm() * c.norm()};
}

}  // namespace

CellFault fault_of(const Mesh& mesh, std::int64_t cell) {
  const auto nodes = mesh.cell(cell);
  if (const CellFault fault = node_fault(mesh, nodes); fault != CellFault::none) return fault;
  int n_positive = 0, n_negative = 0;
  for (const LocalCorner& corner : corners_of(mesh.cell_types[cell])) {
    const auto [jacobian, scale] = jacobian_and_scale(mesh, nodes, corner);
    if (!std::isfinite(jacobian) || !std::isfinite(scale)) return CellFault::not_finite;
    if (std::abs(jacobian) <= least_relative_jacobian * scale) return CellFault::degenerate;
    ++(jacobian > 0 ? n_positive : n_negative);
  }
  if (n_negative == 0) return CellFault::none;
  return n_positive == 0 ? CellFault::reversed : CellFault::folded;
}

std::string description(CellFault fault, int dimension) {
  switch (fault) {
    case CellFault::none:
      return "is sound";
    case CellFault::node_out_of_range:
      return "refers to a node that does not exist";
    case CellFault::not_finite:
      return "has a coordinate that is not finite or far too large";
    case CellFault::repeated_node:
      return "has the same node twice";
    case CellFault::degenerate:
      return dimension == 2 ? "is degenerate: three of its nodes coincide or lie in a line"
                            : "is degenerate: corner nodes coincide or lie in a plane";
    case CellFault::reversed:
      return "is inverted: its Jacobian is negative at every corner (reverse its node order)";
    case CellFault::folded:
      return "is folded: its Jacobian changes sign between corners (re-entrant or twisted)";
  }
  return "is unknown";
}

Vec3 centre_of(const Mesh& mesh, std::int64_t cell) {
  Vec3 sum = Vec3::Zero();
  int n_summed = 0;
  for (const std::int32_t node : mesh.cell(cell)) {
    if (node < 0 || node >= mesh.n_nodes()) continue;
    sum += mesh.nodes[node];
    ++n_summed;
  }
  return sum / std::max(n_summed, 1);
}

void check_cells(const Mesh& mesh, const std::string& name) {
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const CellFault fault = fault_of(mesh, c);
    if (fault == CellFault::none) continue;
    const Vec3 centre = centre_of(mesh, c);
    throw base::InputError(fmt::format("{}: cell {} ({}) at ({:.6g}, {:.6g}, {:.6g}) {}", name, c,
                                       name_of(mesh.cell_types[c]), centre[0], centre[1], centre[2],
                                       description(fault, mesh.dimension)));
  }
}

}  // namespace diptych::meshes
