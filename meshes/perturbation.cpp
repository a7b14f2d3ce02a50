/// Random shifts of interior nodes. A shift is a function of (seed, node, direction, attempt) only,
/// through the mixing function of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): the standard
/// library's distributions differ between libraries. Test: tests/meshes/perturbation_test.cpp.

#include "common/base/error.hpp"
#include "meshes/cell_checks.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/generators.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::meshes {

namespace {

/// Shifts that would fold a cell are drawn again, at most so often.
constexpr int most_attempts = 200;

std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Uniform in [-1, 1), the same on every machine.
double random_number(std::uint64_t seed, std::int64_t node, int attempt, int direction) {
  std::uint64_t bits = mixed(seed);
  bits = mixed(bits ^ static_cast<std::uint64_t>(node));
  bits = mixed(bits ^ static_cast<std::uint64_t>(3 * attempt + direction));
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
}

std::vector<bool> interior_nodes(const Mesh& mesh) {
  std::vector<bool> is_interior(mesh.n_nodes(), true);
  for (const BoundaryFace& face : mesh.boundary_faces) {
    for (int i = 0; i < face.n_nodes; ++i)
      is_interior[face.nodes[i]] = false;
  }
  return is_interior;
}

/// The least length of the cell edges at each node.
std::vector<double> least_edges(const Mesh& mesh) {
  std::vector<double> least(mesh.n_nodes(), std::numeric_limits<double>::infinity());
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto nodes = mesh.cell(c);
    for (const auto& [i, j] : edges_of(mesh.cell_types[c])) {
      const std::int32_t a = nodes[i], b = nodes[j];
      const double length = (mesh.nodes[a] - mesh.nodes[b]).norm();
      least[a] = std::min(least[a], length);
      least[b] = std::min(least[b], length);
    }
  }
  return least;
}

/// The mesh before its nodes are moved, and what their shifts depend on.
struct Unmoved {
  std::vector<Vec3> nodes;
  std::vector<bool> is_interior;
  std::vector<double> least_edge;
  std::uint64_t seed;
};

/// Moves the nodes; those of folded cells again, at most most_attempts times.
/// @return whether no cell is folded in the end
bool moved_soundly(Mesh& mesh, const Unmoved& unmoved, double fraction) {
  std::vector<int> attempts(mesh.n_nodes(), 0);
  std::vector<bool> is_to_be_drawn = unmoved.is_interior;
  for (int round = 0; round < most_attempts; ++round) {
    for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
      if (!is_to_be_drawn[a] || !std::isfinite(unmoved.least_edge[a])) continue;
      for (int d = 0; d < mesh.dimension; ++d) {
        mesh.nodes[a][d] = unmoved.nodes[a][d] + fraction * unmoved.least_edge[a] *
                                                     random_number(unmoved.seed, a, attempts[a], d);
      }
      ++attempts[a];
    }
    is_to_be_drawn.assign(mesh.n_nodes(), false);
    bool all_sound = true;
    for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
      if (fault_of(mesh, c) == CellFault::none) continue;
      all_sound = false;
      for (const std::int32_t a : mesh.cell(c))
        is_to_be_drawn[a] = unmoved.is_interior[a];
    }
    if (all_sound) return true;
  }
  return false;
}

/// The largest fraction in hundredths below one that folds cells which was tried and does not, by
/// bisection; 0 where none was found.
double largest_sound_fraction(Mesh& mesh, const Unmoved& unmoved, double folding) {
  int sound = 0, unsound = std::max(1, static_cast<int>(std::ceil(100 * std::min(folding, 1.0))));
  while (unsound - sound > 1) {
    const int middle = (sound + unsound) / 2;
    (moved_soundly(mesh, unmoved, middle / 100.0) ? sound : unsound) = middle;
  }
  return sound / 100.0;
}

}  // namespace

void perturb_interior(Mesh& mesh, double fraction, std::uint64_t seed) {
  if (!(fraction >= 0) || !std::isfinite(fraction)) {
    throw base::InputError(
        fmt::format("perturbation = {} of the spacing must be zero or positive", fraction));
  }
  if (fraction == 0) return;
  const Unmoved unmoved{mesh.nodes, interior_nodes(mesh), least_edges(mesh), seed};
  if (moved_soundly(mesh, unmoved, fraction)) return;
  const double sound = largest_sound_fraction(mesh, unmoved, fraction);
  mesh.nodes = unmoved.nodes;
  throw base::InputError(fmt::format(
      "perturbation = {} of the spacing folds cells in each of {} draws: {}", fraction,
      most_attempts,
      sound > 0 ? fmt::format("on this mesh, with this seed, {} does not", sound)
                : "no fraction that does not was found; the cells of the mesh are too thin"));
}

}  // namespace diptych::meshes
