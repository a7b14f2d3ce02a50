#include "meshes/deformed_cells.hpp"

#include "common/algebra/lanes.hpp"
#include "common/parallel/for_chunks.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/corner_jacobian.hpp"
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

template <class T>
T least_corner_of(CellType type, const T (&x)[max_cell_nodes][3]) {
  const bool is_plane = dimension_of(type) == 2;
  T least{};
  bool is_first = true;
  for (const LocalCorner& corner : corners_of(type)) {
    const auto& next = corner.neighbours;
    T a[3], b[3], c[3];
    for (int i = 0; i < 3; ++i) {
      a[i] = x[next[0]][i] - x[corner.node][i];
      b[i] = x[next[1]][i] - x[corner.node][i];
      c[i] = x[next[2]][i] - x[corner.node][i];
    }
    const T jacobian = corner_jacobian(is_plane, a, b, c);
    least = is_first ? jacobian : algebra::smaller(jacobian, least);
    is_first = false;
  }
  return least;
}

/// What is known of a cell in its place.
struct Measures {
  double volume;      // m^3, m^2 in 2-D: the integral of the Jacobian
  double corner = 0;  // its least at a corner, where that is asked for
};

enum class Of { volume, volume_and_corners };

/// Corners of a cell, from the first one. @param place  place(node): where the node is, m
template <Of of, class Place>
Measures measures_of_one(const Mesh& mesh, std::int64_t cell, const Place& place) {
  double x[max_cell_nodes][3] = {};
  const auto nodes = mesh.cell(cell);
  const Vec3 origin = place(nodes[0]);
  for (size_t a = 1; a < nodes.size(); ++a) {
    const Vec3 edge = place(nodes[a]) - origin;
    for (int i = 0; i < 3; ++i)
      x[a][i] = edge[i];
  }
  const CellType type = mesh.cell_types[cell];
  Measures measures{volume_by_faces(type, x)};
  if constexpr (of == Of::volume_and_corners) measures.corner = least_corner_of(type, x);
  return measures;
}

/// The same of eight cells of one type.
/// @param cell  the first of them
template <Of of, class Place>
void measure_eight(const Mesh& mesh, std::int64_t cell, const Place& place, Measures* measures) {
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
  const CellType type = mesh.cell_types[cell];
  Lanes corner{};
  if constexpr (of == Of::volume_and_corners) corner = least_corner_of(type, x);
  const Lanes volume = volume_by_faces(type, x);
  for (int lane = 0; lane < n_lanes; ++lane)
    measures[lane] = {volume[lane], corner[lane]};
}

/// Of cells [begin, end).
template <Of of, class Place>
void measure(const Mesh& mesh,
             std::int64_t begin,
             std::int64_t end,
             const Place& place,
             Measures* measures) {
  const auto are_alike = [&](std::int64_t first) {
    for (std::int64_t c = first + 1; c < first + n_lanes; ++c) {
      if (mesh.cell_types[c] != mesh.cell_types[first]) return false;
    }
    return true;
  };
  for (std::int64_t c = begin; c < end;) {
    if (c + n_lanes <= end && are_alike(c)) {
      measure_eight<of>(mesh, c, place, measures + (c - begin));
      c += n_lanes;
    } else {
      measures[c - begin] = measures_of_one<of>(mesh, c, place);
      ++c;
    }
  }
}

/// The least of all and of `next`, whose cells come after.
void add(const DeformedCells::Least& next, DeformedCells::Least& all) {
  all.n_inverted += next.n_inverted;
  all.n_folded += next.n_folded;
  if (all.folded < 0) all.folded = next.folded;
  // what is not finite is the worst of all
  const bool is_worse = std::isnan(next.J) ? !std::isnan(all.J) : next.J < all.J;
  if (!is_worse) return;
  all.J = next.J;
  all.cell = next.cell;
}

constexpr DeformedCells::Least none{std::numeric_limits<double>::infinity(), 0, 0, 0, -1};

}  // namespace

double signed_volume(const Mesh& mesh, std::int64_t cell, std::span<const Vec3> x) {
  const auto place = [&](std::int32_t a) -> const Vec3& { return x[a]; };
  return measures_of_one<Of::volume>(mesh, cell, place).volume;
}

double least_corner_jacobian(const Mesh& mesh, std::int64_t cell, std::span<const Vec3> x) {
  const auto place = [&](std::int32_t a) -> const Vec3& { return x[a]; };
  return measures_of_one<Of::volume_and_corners>(mesh, cell, place).corner;
}

DeformedCells::DeformedCells(const Mesh& mesh)
    : mesh_(mesh), volume_(static_cast<size_t>(mesh.n_cells())) {
  parallel::for_chunks(mesh.n_cells(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    Measures measures[parallel::chunk_size];
    measure<Of::volume>(
        mesh, begin, end, [&](std::int32_t a) -> const Vec3& { return mesh.nodes[a]; }, measures);
    for (std::int64_t c = begin; c < end; ++c)
      volume_[c] = measures[c - begin].volume;
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
        Measures now[parallel::chunk_size], next[parallel::chunk_size];
        measure<Of::volume_and_corners>(
            mesh_, begin, end, [&](std::int32_t a) -> Vec3 { return mesh_.nodes[a] + u[a]; }, now);
        if (!v.empty()) {
          measure<Of::volume>(
              mesh_, begin, end,
              [&](std::int32_t a) -> Vec3 { return mesh_.nodes[a] + u[a] + dt * v[a]; }, next);
        }
        Outlook& part = parts[chunk];
        for (std::int64_t c = begin; c < end; ++c) {
          const double volume = now[c - begin].volume, J = volume / volume_[c];
          const bool is_folded = J > 0 && now[c - begin].corner <= 0;
          add({J, J > 0 ? 0 : 1, c, is_folded ? 1 : 0, is_folded ? c : -1}, part.now);
          if (v.empty() || !(next[c - begin].volume < volume)) continue;
          part.steps_left = std::min(part.steps_left, volume / (volume - next[c - begin].volume));
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
