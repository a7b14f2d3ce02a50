#include "benchmarks/run/wall_watch.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

constexpr double of_spacing = 0.25;

/// Whether each node is on a face of one of these groups.
std::vector<char> nodes_in(const meshes::Mesh& mesh, const std::vector<std::string>& groups) {
  std::vector<char> is_in(static_cast<size_t>(mesh.n_nodes()), 0);
  for (const std::string& group : groups) {
    for (const std::int32_t f : mesh.group(group).faces) {
      const meshes::BoundaryFace& face = mesh.boundary_faces[static_cast<size_t>(f)];
      for (int i = 0; i < face.n_nodes; ++i)
        is_in[static_cast<size_t>(face.nodes[static_cast<size_t>(i)])] = 1;
    }
  }
  return is_in;
}

std::vector<std::int32_t> nodes_of_boundary(const meshes::Mesh& mesh) {
  std::vector<std::int32_t> nodes;
  for (const meshes::BoundaryFace& face : mesh.boundary_faces)
    nodes.insert(nodes.end(), face.nodes.begin(), face.nodes.begin() + face.n_nodes);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Every nth of them.
void thin_out(std::vector<std::int32_t>& nodes, size_t most) {
  const size_t stride = (nodes.size() + most - 1) / most;
  if (stride < 2) return;
  for (size_t k = 0; k * stride < nodes.size(); ++k)
    nodes[k] = nodes[k * stride];
  nodes.resize((nodes.size() + stride - 1) / stride);
}

}  // namespace

WallWatch::WallWatch(const cases::Case& setup, const meshes::Mesh& mesh, double spacing)
    : spacing_(spacing) {
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    if (boundary.type != "rigid-wall") continue;
    Wall wall;
    wall.point = boundary.point;
    wall.normal = boundary.normal.normalized();
    wall.groups = fmt::format("{}", fmt::join(boundary.groups, ", "));
    const std::vector<char> may_touch = nodes_in(mesh, boundary.groups);
    for (const std::int32_t a : nodes_of_boundary(mesh)) {
      const double distance = (mesh.nodes[static_cast<size_t>(a)] - wall.point).dot(wall.normal);
      if (may_touch[static_cast<size_t>(a)] == 0 && distance > -of_spacing * spacing)
        wall.nodes.push_back(a);
    }
    thin_out(wall.nodes, 2000);
    for (const std::int32_t a : wall.nodes)
      wall.X.push_back(mesh.nodes[static_cast<size_t>(a)]);
    walls_.push_back(std::move(wall));
  }
}

void WallWatch::at_output(const run::Output& output) {
  for (Wall& wall : walls_) {
    if (wall.nodes.empty()) continue;
    const scheme::Snapshot fields = output.state.fields_of(wall.nodes);
    for (size_t k = 0; k < wall.nodes.size(); ++k) {
      const double depth = (wall.point - wall.X[k] - fields.u[k]).dot(wall.normal);
      if (depth <= wall.depth) continue;
      wall.depth = depth;
      wall.node = static_cast<std::int64_t>(k);
      wall.time = output.state.time();
    }
  }
}

void WallWatch::archive(algebra::Archive& archive) {
  for (size_t k = 0; k < walls_.size(); ++k) {
    const std::string name = fmt::format("wall watch/{} ", k);
    archive.real(name + "depth", "m", walls_[k].depth);
    archive.integer(name + "node", walls_[k].node);
    archive.real(name + "time", "s", walls_[k].time);
  }
}

std::optional<std::string> WallWatch::notice() const {
  for (const Wall& wall : walls_) {
    if (wall.depth <= of_spacing * spacing_) continue;
    const algebra::Vec3& X = wall.X[static_cast<size_t>(wall.node)];
    return fmt::format(
        "the body went through a rigid wall: the node at X = ({:.4g}, {:.4g}, {:.4g}) m was {:.3g} "
        "m behind it at t = {:.4g} s; only the group{} {} may touch it: name there all sides that "
        "come to it",
        X.x(), X.y(), X.z(), wall.depth, wall.time,
        wall.groups.find(',') == std::string::npos ? "" : "s", wall.groups);
  }
  return std::nullopt;
}

}  // namespace diptych::harness
