/// Boundary groups of a .msh file: elements of physical groups are matched with the boundary faces
/// of the cells. A face inside the mesh is an error: it has no outside, and a traction or a support
/// on it would act on cells of both sides.

#include "meshes/msh/cells.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace diptych::meshes::msh {

namespace {

/// Nodes of a face, ascending, the absent ones as the greatest number.
using FaceKey = std::array<std::int32_t, 4>;
constexpr std::int32_t no_node = std::numeric_limits<std::int32_t>::max();

class FaceIndex {
 public:
  explicit FaceIndex(const Mesh& mesh) {
    faces_.reserve(mesh.boundary_faces.size());
    for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
      const BoundaryFace& face = mesh.boundary_faces[f];
      FaceKey key{no_node, no_node, no_node, no_node};
      std::copy_n(face.nodes.begin(), face.n_nodes, key.begin());
      std::sort(key.begin(), key.end());
      faces_.emplace_back(key, static_cast<std::int32_t>(f));
    }
    std::sort(faces_.begin(), faces_.end());
  }

  /// Index of the boundary face of these nodes, -1 where there is none.
  std::int32_t find(const FaceKey& key) const {
    const auto found = std::lower_bound(faces_.begin(), faces_.end(), std::pair{key, 0});
    return found != faces_.end() && found->first == key ? found->second : -1;
  }

 private:
  std::vector<std::pair<FaceKey, std::int32_t>> faces_;
};

bool some_cell_holds(const Mesh& mesh, const FaceKey& key) {
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto nodes = mesh.cell(c);
    const bool holds_all = std::all_of(key.begin(), key.end(), [&](std::int32_t a) {
      return a == no_node || std::find(nodes.begin(), nodes.end(), a) != nodes.end();
    });
    if (holds_all) return true;
  }
  return false;
}

/// Collects the faces of all groups.
class GroupCollector {
 public:
  GroupCollector(const Source& source,
                 const Contents& contents,
                 const NodeNumbers& numbers,
                 const Mesh& mesh)
      : source_(source), contents_(contents), numbers_(numbers), mesh_(mesh), index_(mesh) {}

  void add(const ElementBlock& block) {
    for (const int tag : physical_tags_of(contents_, block)) {
      auto& faces = faces_[tag];
      for (size_t i = 0; i < block.tags.size(); ++i) {
        faces.emplace_back(face_of(block, i, tag), block.places[i]);
      }
    }
  }

  std::vector<BoundaryGroup> groups() {
    refuse_empty_groups();
    std::vector<BoundaryGroup> result;
    std::set<std::string> names;
    for (auto& [tag, faces] : faces_) {
      BoundaryGroup group;
      group.name = name_of(tag);
      if (!names.insert(group.name).second) {
        source_.fail_without_place(fmt::format(
            "two boundary groups are called '{}' (one of them by its tag)", group.name));
      }
      std::sort(faces.begin(), faces.end());
      for (size_t i = 0; i < faces.size(); ++i) {
        if (i > 0 && faces[i].first == faces[i - 1].first) {
          source_.fail_at(faces[i].second, fmt::format("a face stands twice in {}", shown_of(tag)));
        }
        group.faces.push_back(faces[i].first);
      }
      result.push_back(std::move(group));
    }
    return result;
  }

 private:
  std::string name_of(int tag) const {
    const auto found = contents_.physical_names.find({mesh_.dimension - 1, tag});
    return found == contents_.physical_names.end() ? fmt::format("{}", tag) : found->second.name;
  }

  /// "physical surface 'top'"
  std::string shown_of(int tag) const {
    return fmt::format("physical {} '{}'", mesh_.dimension == 3 ? "surface" : "curve",
                       name_of(tag));
  }

  /// A named group without faces would make a boundary condition act on nothing.
  void refuse_empty_groups() const {
    for (const auto& [key, physical] : contents_.physical_names) {
      if (key.first != mesh_.dimension - 1 || faces_.contains(key.second)) continue;
      source_.fail_at(physical.place,
                      fmt::format("{} has no faces in the file: mesh it, or remove the group",
                                  shown_of(key.second)));
    }
  }

  std::int32_t face_of(const ElementBlock& block, size_t element, int group) const {
    FaceKey key{no_node, no_node, no_node, no_node};
    for (int k = 0; k < block.n_nodes; ++k) {
      const std::int64_t tag = block.nodes[element * block.n_nodes + k];
      key[k] = numbers_.index_of(tag);
      if (key[k] == -2) {
        source_.fail_at(block.places[element],
                        fmt::format("element {} of {} refers to node {}, which the file lacks",
                                    block.tags[element], shown_of(group), tag));
      }
    }
    std::sort(key.begin(), key.end());
    const std::int32_t face = index_.find(key);
    if (face < 0) refuse_face(block, element, group, key);
    return face;
  }

  [[noreturn]] void refuse_face(const ElementBlock& block,
                                size_t element,
                                int group,
                                const FaceKey& key) const {
    const bool is_inside = key[0] >= 0 && some_cell_holds(mesh_, key);
    source_.fail_at(
        block.places[element],
        fmt::format("element {} of {} {}", block.tags[element], shown_of(group),
                    is_inside ? "lies inside the mesh: only boundary faces can carry a condition, "
                                "take the interior part out of the group"
                              : "is not a face of any cell: mesh all dimensions together"));
  }

  const Source& source_;
  const Contents& contents_;
  const NodeNumbers& numbers_;
  const Mesh& mesh_;
  FaceIndex index_;
  /// By physical tag: boundary face, and place of the element in the file.
  std::map<int, std::vector<std::pair<std::int32_t, std::int64_t>>> faces_;
};

}  // namespace

void take_groups(const Source& source,
                 const Contents& contents,
                 const NodeNumbers& numbers,
                 Mesh& mesh) {
  GroupCollector collector(source, contents, numbers, mesh);
  for (const ElementBlock& block : contents.blocks) {
    if (block.dimension == mesh.dimension - 1) collector.add(block);
  }
  mesh.boundary_groups = collector.groups();
}

}  // namespace diptych::meshes::msh
