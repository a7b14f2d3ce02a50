#include "benchmarks/run/sliding_watch.hpp"

#include "common/cases/reader.hpp"
#include "meshes/curved_groups.hpp"
#include "meshes/shape_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>

namespace diptych::harness {

namespace {

using algebra::Mat3;
using algebra::Vec3;

constexpr double worth_telling = 0.01;
constexpr std::int64_t most_nodes = 2000;

/// What the faces of a condition's groups say of a node.
struct SideNode {
  Vec3 normal = Vec3::Zero();    // of unit length in the end
  double least_cosine = 1;       // of the normals of its faces to it
  Mat3 squares = Mat3::Zero();   // of the ways to its neighbours, m^2
  Mat3 turnings = Mat3::Zero();  // of the normal along them, times the way, m
};

template <class Use>
void for_faces(const meshes::Mesh& mesh, const std::vector<std::string>& groups, const Use& use) {
  for (const std::string& group : groups)
    for (const std::int32_t f : mesh.group(group).faces)
      use(mesh.boundary_faces[static_cast<size_t>(f)]);
}

/// At edges between planes both normals are held.
bool is_smooth(const SideNode& node) {
  static const double least_cosine =
      std::cos(0.5 * meshes::edge_of_planes * std::numbers::pi / 180);
  return node.least_cosine > least_cosine;
}

std::map<std::int32_t, SideNode> nodes_of(const meshes::Mesh& mesh,
                                          const std::vector<std::string>& groups) {
  std::map<std::int32_t, SideNode> nodes;
  const auto for_corners = [](const meshes::BoundaryFace& face, const auto& use) {
    for (int k = 0; k < face.n_nodes; ++k)
      use(face.nodes[k], face.nodes[(k + 1) % face.n_nodes]);
  };
  for_faces(mesh, groups, [&](const meshes::BoundaryFace& face) {
    for_corners(face, [&](std::int32_t a, std::int32_t) {
      nodes[a].normal += face_area(face, mesh.nodes);
    });
  });
  for (auto& entry : nodes)
    entry.second.normal.normalize();
  for_faces(mesh, groups, [&](const meshes::BoundaryFace& face) {
    const Vec3 normal = face_area(face, mesh.nodes).normalized();
    for_corners(face, [&](std::int32_t a, std::int32_t) {
      SideNode& node = nodes[a];
      node.least_cosine = std::min(node.least_cosine, normal.dot(node.normal));
    });
  });
  for_faces(mesh, groups, [&](const meshes::BoundaryFace& face) {
    for_corners(face, [&](std::int32_t a, std::int32_t b) {
      SideNode &first = nodes[a], &second = nodes[b];
      if (!is_smooth(first) || !is_smooth(second)) return;
      const Vec3 way = mesh.nodes[static_cast<size_t>(b)] - mesh.nodes[static_cast<size_t>(a)];
      const Mat3 square = way * way.transpose();
      const Mat3 turning = (second.normal - first.normal) * way.transpose();
      for (SideNode* node : {&first, &second}) {
        node->squares += square;
        node->turnings += turning;
      }
    });
  });
  return nodes;
}

}  // namespace

SlidingWatch::SlidingWatch(const cases::Case& setup, const meshes::Mesh& mesh) {
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    if (boundary.type != "symmetry") continue;
    Side side;
    side.groups = fmt::format("{}", fmt::join(boundary.groups, ", "));
    const auto nodes = nodes_of(mesh, boundary.groups);
    const std::int64_t stride = std::ssize(nodes) / most_nodes + 1;
    std::int64_t count = 0;
    for (const auto& [a, node] : nodes) {
      if (count++ % stride != 0) continue;
      // along the normal, and in two dimensions across the plane, no way goes: there it stays
      const double size = node.squares.trace();
      if (size == 0) continue;
      Mat3 squares = node.squares + size * node.normal * node.normal.transpose();
      if (cases::dimension_of(setup.mesh) == 2) squares(2, 2) += size;
      const Mat3 turning = node.turnings * squares.inverse();
      if (turning.norm() * std::sqrt(size) < 1e-9 || !turning.allFinite()) continue;
      side.nodes.push_back(a);
      side.turning.push_back(turning * (Mat3::Identity() - node.normal * node.normal.transpose()));
    }
    if (!side.nodes.empty()) sides_.push_back(std::move(side));
  }
}

void SlidingWatch::at_output(const run::Output& output) {
  for (Side& side : sides_) {
    const scheme::Snapshot fields = output.state.fields_of(side.nodes);
    for (size_t k = 0; k < side.nodes.size(); ++k) {
      const double turned = (side.turning[k] * fields.u[k]).norm();
      if (turned <= side.turned) continue;
      side.turned = turned;
      side.slid = fields.u[k].norm();
      side.time = output.state.time();
    }
  }
}

void SlidingWatch::archive(algebra::Archive& archive) {
  for (size_t k = 0; k < sides_.size(); ++k) {
    const std::string name = fmt::format("sliding watch/{} ", k);
    archive.real(name + "turned", "rad", sides_[k].turned);
    archive.real(name + "slid", "m", sides_[k].slid);
    archive.real(name + "time", "s", sides_[k].time);
  }
}

std::optional<std::string> SlidingWatch::notice() const {
  for (const Side& side : sides_) {
    if (side.turned <= worth_telling) continue;
    return fmt::format(
        "nodes slid along a curved side (group{} {}, type symmetry) by up to {:.3g} m at t = "
        "{:.4g} "
        "s, to where its normal has turned by {:.2g}: each keeps the tangent plane where it began, "
        "so that they left the side by some {:.2g} m and a body that should slide on swings; what "
        "is held that way is right for displacements small beside the radius",
        side.groups.find(',') == std::string::npos ? "" : "s", side.groups, side.slid, side.time,
        side.turned, 0.5 * side.turned * side.slid);
  }
  return std::nullopt;
}

}  // namespace diptych::harness
