#include "meshes/deformed_cells.hpp"

#include "common/algebra/lanes.hpp"
#include "common/parallel/for_chunks.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/face_flux.hpp"
#include "meshes/shape_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::meshes {

using algebra::Lanes;
using algebra::n_lanes;

namespace {

/// Of one cell, or of eight with the same bits: compiled without fused multiply-adds.
/// @param x  corners, from the first one: a body far from the origin loses no digits
template <class T>
T volume_by_faces(CellType type, const T (&x)[max_cell_nodes][3]) {
  T volume{};
  for (const LocalFace& face : faces_of(type)) {
    const auto& corner = face.nodes;
    if (face.n_nodes == 2) {
      volume = volume + area_under_edge(x[corner[0]], x[corner[1]]);
    } else {
      volume = volume + volume_under_face(x[corner[0]], x[corner[1]], x[corner[2]],
                                          x[corner[face.n_nodes == 4 ? 3 : 0]]);
    }
  }
  return volume;
}

/// @param place  place(node): where the node is, m
template <class Place>
double volume_of_one(const Mesh& mesh, std::int64_t cell, const Place& place) {
  double x[max_cell_nodes][3] = {};
  const auto nodes = mesh.cell(cell);
  const Vec3 origin = place(nodes[0]);
  for (size_t a = 1; a < nodes.size(); ++a) {
    const Vec3 edge = place(nodes[a]) - origin;
    for (int i = 0; i < 3; ++i)
      x[a][i] = edge[i];
  }
  return volume_by_faces(mesh.cell_types[cell], x);
}

/// The same of eight cells of one type.
/// @param cell  the first of them
template <class Place>
void volumes_of_eight(const Mesh& mesh, std::int64_t cell, const Place& place, double* volumes) {
  Lanes x[max_cell_nodes][3];
  for (int i = 0; i < 3; ++i)
    x[0][i] = Lanes{};
  for (int lane = 0; lane < n_lanes; ++lane) {
    const auto nodes = mesh.cell(cell + lane);
    const Vec3 origin = place(nodes[0]);
    for (size_t a = 1; a < nodes.size(); ++a) {
      const Vec3 edge = place(nodes[a]) - origin;
      for (int i = 0; i < 3; ++i)
        x[a][i][lane] = edge[i];
    }
  }
  const Lanes volume = volume_by_faces(mesh.cell_types[cell], x);
  for (int lane = 0; lane < n_lanes; ++lane)
    volumes[lane] = volume[lane];
}

/// Of cells [begin, end).
template <class Place>
void put_volumes(
    const Mesh& mesh, std::int64_t begin, std::int64_t end, const Place& place, double* volumes) {
  const auto are_alike = [&](std::int64_t first) {
    for (std::int64_t c = first + 1; c < first + n_lanes; ++c) {
      if (mesh.cell_types[c] != mesh.cell_types[first]) return false;
    }
    return true;
  };
  for (std::int64_t c = begin; c < end;) {
    if (c + n_lanes <= end && are_alike(c)) {
      volumes_of_eight(mesh, c, place, volumes + (c - begin));
      c += n_lanes;
    } else {
      volumes[c - begin] = volume_of_one(mesh, c, place);
      ++c;
    }
  }
}

/// The least of all and of `next`, whose cells come after.
void add(const DeformedCells::Least& next, DeformedCells::Least& all) {
  all.n_inverted += next.n_inverted;
  // what is not finite is the worst of all
  const bool is_worse = std::isnan(next.J) ? !std::isnan(all.J) : next.J < all.J;
  if (!is_worse) return;
  all.J = next.J;
  all.cell = next.cell;
}

constexpr DeformedCells::Least none{std::numeric_limits<double>::infinity(), 0, 0};

}  // namespace

double signed_volume(const Mesh& mesh, std::int64_t cell, std::span<const Vec3> x) {
  return volume_of_one(mesh, cell, [&](std::int32_t a) -> const Vec3& { return x[a]; });
}

DeformedCells::DeformedCells(const Mesh& mesh)
    : mesh_(mesh), volume_(static_cast<size_t>(mesh.n_cells())) {
  parallel::for_chunks(mesh.n_cells(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    put_volumes(
        mesh, begin, end, [&](std::int32_t a) -> const Vec3& { return mesh.nodes[a]; },
        volume_.data() + begin);
  });
}

DeformedCells::Outlook DeformedCells::outlook(std::span<const Vec3> u,
                                              std::span<const Vec3> v,
                                              double dt) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto n_chunks = static_cast<size_t>(parallel::n_chunks_of(mesh_.n_cells()));
  std::vector<Outlook> parts(n_chunks, {none, never});
  parallel::for_chunks(
      mesh_.n_cells(), [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
        double now[parallel::chunk_size], next[parallel::chunk_size];
        put_volumes(
            mesh_, begin, end, [&](std::int32_t a) -> Vec3 { return mesh_.nodes[a] + u[a]; }, now);
        if (!v.empty()) {
          put_volumes(
              mesh_, begin, end,
              [&](std::int32_t a) -> Vec3 { return mesh_.nodes[a] + u[a] + dt * v[a]; }, next);
        }
        Outlook& part = parts[chunk];
        for (std::int64_t c = begin; c < end; ++c) {
          const double volume = now[c - begin], J = volume / volume_[c];
          add({J, J > 0 ? 0 : 1, c}, part.now);
          if (v.empty() || !(next[c - begin] < volume)) continue;
          part.steps_left = std::min(part.steps_left, volume / (volume - next[c - begin]));
        }
      });
  Outlook all{none, never};
  for (const Outlook& part : parts) {
    add(part.now, all.now);
    all.steps_left = std::min(all.steps_left, part.steps_left);
  }
  return all;
}

}  // namespace diptych::meshes
