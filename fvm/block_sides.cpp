#include "fvm/block_sides.hpp"

#include "meshes/gmsh.hpp"

#include <array>

namespace diptych::fvm {

using algebra::Mat3;
using algebra::Vec3;
using meshes::LatticeBlock;

namespace {

/// Part of the area or the volume below which a sum is round-off.
constexpr double round_off = 1e-12;

}  // namespace

BlockSides::BlockSides(const meshes::Mesh& mesh)
    : mesh_(mesh), groups_(meshes::groups_of_faces(mesh)) {}

/// The groups of a side, which its faces have in common (lattice_blocks.hpp cuts where groups end);
/// nullptr where it is glued to another block.
const std::vector<int>* BlockSides::groups_of(const LatticeBlock& block, int d, bool is_far) const {
  std::array<std::int32_t, 4> nodes{};
  const int n = block.dimension == 3 ? 4 : 2;
  for (int i = 0; i < n; ++i) {
    std::array<int, 3> at{0, 0, 0};
    at[d] = is_far ? block.n_nodes[d] - 1 : 0;
    const int first = (d + 1) % block.dimension;
    at[first] = i & 1;
    if (n == 4) at[(d + 2) % 3] = i >> 1;
    nodes[i] = block.node[static_cast<size_t>(block.index(at))];
  }
  const auto found = groups_.find(meshes::key_of({nodes.data(), static_cast<size_t>(n)}));
  return found == groups_.end() ? nullptr : &found->second;
}

void BlockSides::add(const BlockMetrics& metrics) {
  const LatticeBlock& block = metrics.block();
  for (int d = 0; d < block.dimension; ++d) {
    if (block.is_closed[d]) continue;
    for (const bool is_far : {false, true}) {
      const std::vector<int>* groups = groups_of(block, d, is_far);
      if (groups == nullptr) continue;
      const int end = is_far ? block.n_nodes[d] - 1 : 0;
      for (std::int64_t p = 0; p < block.n_places(); ++p) {
        if (block.place(p)[d] != end) continue;
        const Vec3 M = metrics.area(p, d);
        shares_.push_back({block.node[static_cast<size_t>(p)], groups, is_far ? M : Vec3(-M)});
      }
    }
  }
}

void BlockSides::balance(double volume) {
  const Vec3 origin = mesh_.nodes[0];
  double weight = 0;
  Vec3 first = Vec3::Zero(), sum = Vec3::Zero();
  for (const Share& share : shares_) {
    weight += share.area.norm();
    first += share.area.norm() * (mesh_.nodes[share.node] - origin);
    sum += share.area;
  }
  const Vec3 centre = origin + first / weight;
  Mat3 second = Mat3::Zero(), missing = Mat3::Zero();
  missing.diagonal().head(mesh_.dimension).setConstant(volume);
  for (const Share& share : shares_) {
    const Vec3 X = mesh_.nodes[share.node] - centre;
    second += share.area.norm() * X * X.transpose();
    missing -= X * share.area.transpose();
  }
  if (sum.norm() <= round_off * weight && missing.norm() <= round_off * volume) return;
  if (mesh_.dimension == 2) second(2, 2) = second.trace();
  const Mat3 G = missing.transpose() * second.inverse();
  for (Share& share : shares_) {
    const Vec3 X = mesh_.nodes[share.node] - centre;
    share.area += share.area.norm() * (G * X - sum / weight);
  }
}

void BlockSides::finish(scheme::PairGraph& graph) {
  long double volume = 0;
  for (const double Omega : graph.Omega)
    volume += Omega;
  balance(static_cast<double>(volume));
  graph.boundary_area.assign(graph.X.size(), Vec3::Zero());
  std::vector<std::map<std::int32_t, Vec3>> areas(mesh_.boundary_groups.size());
  for (const Share& share : shares_) {
    graph.boundary_area[share.node] += share.area;
    for (const int g : *share.groups)
      areas[g].try_emplace(share.node, Vec3::Zero()).first->second += share.area;
  }
  for (size_t g = 0; g < areas.size(); ++g) {
    scheme::BoundaryPatch& patch = graph.patches.emplace_back();
    patch.name = mesh_.boundary_groups[g].name;
    patch.faces = meshes::corners_of(mesh_, mesh_.boundary_groups[g]);
    for (const auto& [node, area] : areas[g]) {
      patch.nodes.push_back(node);
      patch.area.push_back(area);
    }
  }
}

}  // namespace diptych::fvm
