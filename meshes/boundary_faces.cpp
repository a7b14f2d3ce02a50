/// Boundary faces: those that belong to one cell only. Every face of every cell becomes a record,
/// records are put into one bucket per least node (counting sort), each small bucket is sorted, and
/// equal neighbours are paired. O(n) and the same on every machine. The boundary is kept in the
/// order of cells, then of local faces. Test: tests/meshes/boundary_faces_test.cpp.

#include "common/base/error.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/gmsh.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace diptych::meshes {

namespace {

constexpr std::uint32_t faces_stride = 8;  ///< face id = cell * stride + local face
static_assert(most_cells <= std::numeric_limits<std::uint32_t>::max() / faces_stride);
static_assert(most_faces <= static_cast<int>(faces_stride));

/// A face without its least node, which is the bucket. Absent nodes stand last, as the greatest
/// number.
struct FaceRecord {
  std::array<std::int32_t, 3> others{};  ///< ascending
  std::uint32_t id = 0;

  bool operator<(const FaceRecord& other) const {
    return others != other.others ? others < other.others : id < other.id;
  }
};

BoundaryFace face_of(const Mesh& mesh, std::uint32_t id) {
  const std::int64_t cell = id / faces_stride;
  const LocalFace& local = faces_of(mesh.cell_types[cell])[id % faces_stride];
  const auto nodes = mesh.cell(cell);
  BoundaryFace face;
  face.n_nodes = local.n_nodes;
  for (int i = 0; i < local.n_nodes; ++i)
    face.nodes[i] = nodes[local.nodes[i]];
  return face;
}

/// Calls visit(id, face, least node) for all faces of all cells.
template <class Visit>
void for_each_face(const Mesh& mesh, Visit visit) {
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto nodes = mesh.cell(c);
    std::uint32_t id = static_cast<std::uint32_t>(c) * faces_stride;
    for (const LocalFace& local : faces_of(mesh.cell_types[c])) {
      BoundaryFace face;
      face.n_nodes = local.n_nodes;
      std::int32_t least = nodes[local.nodes[0]];
      for (int i = 0; i < local.n_nodes; ++i) {
        face.nodes[i] = nodes[local.nodes[i]];
        least = std::min(least, face.nodes[i]);
      }
      visit(id++, face, least);
    }
  }
}

constexpr std::int32_t no_node = std::numeric_limits<std::int32_t>::max();

FaceRecord record_of(std::uint32_t id, const BoundaryFace& face) {
  std::array<std::int32_t, 4> n{no_node, no_node, no_node, no_node};
  for (int i = 0; i < face.n_nodes; ++i)
    n[i] = face.nodes[i];
  const auto order = [&](int i, int j) {
    if (n[j] < n[i]) std::swap(n[i], n[j]);
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);  // sorting network
  return {{n[1], n[2], n[3]}, id};
}

/// Whether two faces of the same nodes run around them in opposite senses, as seen from two cells
/// on either side.
bool are_opposite(const BoundaryFace& a, const BoundaryFace& b) {
  const int n = a.n_nodes;
  if (n == 2) return a.nodes[0] == b.nodes[1];
  int start = 0;
  while (start < n && b.nodes[start] != a.nodes[0])
    ++start;
  if (start == n) return false;
  for (int i = 0; i < n; ++i) {
    if (a.nodes[i] != b.nodes[(start + n - i) % n]) return false;
  }
  return true;
}

[[noreturn]] void refuse_shared_face(const Mesh& mesh, std::span<const FaceRecord> sharing) {
  const BoundaryFace face = face_of(mesh, sharing[0].id);
  Vec3 centre = Vec3::Zero();
  for (int i = 0; i < face.n_nodes; ++i)
    centre += mesh.nodes[face.nodes[i]] / face.n_nodes;
  const std::string where =
      fmt::format("{} at ({:.6g}, {:.6g}, {:.6g})", face.n_nodes == 2 ? "the edge" : "the face",
                  centre[0], centre[1], centre[2]);
  if (sharing.size() > 2) {
    throw base::InputError(fmt::format(
        "{} belongs to {} cells (numbers {}, {}, {}{}), at most two can share it: "
        "remove cells that were made twice",
        where, sharing.size(), sharing[0].id / faces_stride, sharing[1].id / faces_stride,
        sharing[2].id / faces_stride, sharing.size() > 3 ? ", ..." : ""));
  }
  throw base::InputError(
      fmt::format("{} has its two cells (numbers {} and {}) on the same side: they overlap, remove "
                  "one of them",
                  where, sharing[0].id / faces_stride, sharing[1].id / faces_stride));
}

/// Marks the faces of one bucket that have no partner.
void mark_single_faces(const Mesh& mesh,
                       std::span<FaceRecord> bucket,
                       std::vector<bool>& is_boundary) {
  std::sort(bucket.begin(), bucket.end());
  for (size_t first = 0; first < bucket.size();) {
    size_t last = first + 1;
    while (last < bucket.size() && bucket[last].others == bucket[first].others)
      ++last;
    const auto sharing = bucket.subspan(first, last - first);
    if (sharing.size() == 1) {
      is_boundary[sharing[0].id] = true;
    } else if (sharing.size() > 2 ||
               !are_opposite(face_of(mesh, sharing[0].id), face_of(mesh, sharing[1].id))) {
      refuse_shared_face(mesh, sharing);
    }
    first = last;
  }
}

using Triple = std::array<std::int32_t, 3>;

/// A quadrilateral face of one cell against triangles of others leaves a crack between them.
void refuse_split_quadrilaterals(const Mesh& mesh) {
  std::vector<Triple> halves;
  const auto sorted = [](std::int32_t a, std::int32_t b, std::int32_t c) {
    Triple triple{a, b, c};
    std::sort(triple.begin(), triple.end());
    return triple;
  };
  bool has_triangles = false;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    has_triangles |= face.n_nodes == 3;
    if (face.n_nodes != 4) continue;
    const auto& n = face.nodes;
    for (int i = 0; i < 4; ++i)
      halves.push_back(sorted(n[i], n[(i + 1) % 4], n[(i + 2) % 4]));
  }
  if (halves.empty() || !has_triangles) return;
  std::sort(halves.begin(), halves.end());
  for (const BoundaryFace& face : mesh.boundary_faces) {
    if (face.n_nodes != 3) continue;
    const auto& n = face.nodes;
    if (!std::binary_search(halves.begin(), halves.end(), sorted(n[0], n[1], n[2]))) continue;
    const Vec3& place = mesh.nodes[n[0]];
    throw base::InputError(
        fmt::format("a triangular face near ({:.6g}, {:.6g}, {:.6g}) covers half of a "
                    "quadrilateral one: the cells do not conform (pyramids are not supported); "
                    "use one cell type on both sides",
                    place[0], place[1], place[2]));
  }
}

}  // namespace

void find_boundary_faces(Mesh& mesh) {
  if (mesh.n_cells() > most_cells) {
    throw base::InputError(
        fmt::format("{} cells are too many, at most {} are supported", mesh.n_cells(), most_cells));
  }
  std::vector<std::int64_t> bucket_ends(mesh.n_nodes() + 1, 0);
  for_each_face(mesh, [&](std::uint32_t, const BoundaryFace&, std::int32_t least) {
    ++bucket_ends[least + 1];
  });
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a)
    bucket_ends[a + 1] += bucket_ends[a];
  std::vector<FaceRecord> records(bucket_ends.back());
  std::vector<std::int64_t> next(bucket_ends.begin(), bucket_ends.end() - 1);
  for_each_face(mesh, [&](std::uint32_t id, const BoundaryFace& face, std::int32_t least) {
    records[next[least]++] = record_of(id, face);
  });

  std::vector<bool> is_boundary(mesh.n_cells() * faces_stride, false);
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    mark_single_faces(
        mesh,
        {records.data() + bucket_ends[a], static_cast<size_t>(bucket_ends[a + 1] - bucket_ends[a])},
        is_boundary);
  }
  mesh.boundary_faces.clear();
  for (size_t id = 0; id < is_boundary.size(); ++id) {
    if (!is_boundary[id]) continue;
    mesh.boundary_faces.push_back(face_of(mesh, static_cast<std::uint32_t>(id)));
  }
  if (mesh.dimension == 3) refuse_split_quadrilaterals(mesh);
}

std::vector<std::array<std::int32_t, 4>> corners_of(const Mesh& mesh, const BoundaryGroup& group) {
  std::vector<std::array<std::int32_t, 4>> corners;
  for (const std::int32_t f : group.faces) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    corners.push_back({-1, -1, -1, -1});
    std::copy_n(face.nodes.begin(), face.n_nodes, corners.back().begin());
  }
  return corners;
}

}  // namespace diptych::meshes
