#include "meshes/msh/cells.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace diptych::meshes::msh {

NodeNumbers::NodeNumbers(const Contents& contents, int cell_dimension, const Source& source)
    : contents_(contents), index_(contents.node_tags.size(), -1) {
  for (const ElementBlock& block : contents.blocks) {
    if (block.dimension != cell_dimension) continue;
    for (size_t i = 0; i < block.nodes.size(); ++i) {
      const std::int64_t position = position_of(block.nodes[i]);
      if (position < 0) {
        const size_t element = i / block.n_nodes;
        source.fail_at(block.places[element],
                       fmt::format("element {} refers to node {}, which the file lacks",
                                   block.tags[element], block.nodes[i]));
      }
      index_[position] = 0;
    }
  }
  for (std::int32_t& index : index_) {
    if (index < 0) continue;
    if (n_used_ == std::numeric_limits<std::int32_t>::max()) {
      source.fail_without_place("more nodes than 32-bit indices can number");
    }
    index = static_cast<std::int32_t>(n_used_++);
  }
}

std::int64_t NodeNumbers::position_of(std::int64_t tag) const {
  const auto& tags = contents_.node_tags;
  if (tags.empty() || tag < tags.front() || tag > tags.back()) return -1;
  const std::int64_t offset = tag - tags.front();
  if (tags.back() - tags.front() + 1 == static_cast<std::int64_t>(tags.size())) return offset;
  const auto found = std::lower_bound(tags.begin(), tags.end(), tag);
  return *found == tag ? found - tags.begin() : -1;
}

std::int32_t NodeNumbers::index_of(std::int64_t tag) const {
  const std::int64_t position = position_of(tag);
  return position < 0 ? -2 : index_[position];
}

std::vector<Vec3> NodeNumbers::nodes() const {
  std::vector<Vec3> used;
  used.reserve(n_used_);
  for (size_t i = 0; i < index_.size(); ++i) {
    if (index_[i] >= 0) used.push_back(contents_.node_places[i]);
  }
  return used;
}

const std::vector<int>& physical_tags_of(const Contents& contents, const ElementBlock& block) {
  static const std::vector<int> none;
  if (!contents.is_version_4) return block.physical_tags;
  const auto found = contents.physical_tags.find(block.entity);
  return found == contents.physical_tags.end() ? none : found->second;
}

namespace {

/// An element of the file: block and number in the block.
struct ElementRef {
  std::int32_t block = 0;
  std::int64_t element = 0;
};

std::span<const std::int64_t> nodes_of(const Contents& contents, const ElementRef& ref) {
  const ElementBlock& block = contents.blocks[ref.block];
  return {block.nodes.data() + ref.element * block.n_nodes, static_cast<size_t>(block.n_nodes)};
}

/// Version 2.2: blocks of one type and entity but of several physical groups may hold the same
/// elements. Marks the repetitions.
std::vector<std::vector<bool>> repetitions(const Source& source,
                                           const Contents& contents,
                                           int dimension) {
  std::vector<std::vector<bool>> is_repeated(contents.blocks.size());
  std::map<std::pair<int, int>, std::vector<std::int32_t>> blocks_of;  // by type and entity
  for (size_t b = 0; b < contents.blocks.size(); ++b) {
    const ElementBlock& block = contents.blocks[b];
    is_repeated[b].assign(block.tags.size(), false);
    if (contents.is_version_4 || block.dimension != dimension) continue;
    blocks_of[{block.type, block.entity.second}].push_back(static_cast<std::int32_t>(b));
  }
  for (const auto& [key, blocks] : blocks_of) {
    if (blocks.size() < 2) continue;
    std::vector<ElementRef> refs;
    for (const std::int32_t b : blocks) {
      for (size_t i = 0; i < contents.blocks[b].tags.size(); ++i) {
        refs.push_back({b, static_cast<std::int64_t>(i)});
      }
    }
    std::stable_sort(refs.begin(), refs.end(), [&](const ElementRef& a, const ElementRef& b) {
      return std::ranges::lexicographical_compare(nodes_of(contents, a), nodes_of(contents, b));
    });
    for (size_t i = 1; i < refs.size(); ++i) {
      if (!std::ranges::equal(nodes_of(contents, refs[i - 1]), nodes_of(contents, refs[i]))) {
        continue;
      }
      const ElementBlock& block = contents.blocks[refs[i].block];
      if (refs[i - 1].block == refs[i].block) {
        source.fail_at(block.places[refs[i].element],
                       fmt::format("element {} repeats the nodes of element {}",
                                   block.tags[refs[i].element], block.tags[refs[i - 1].element]));
      }
      is_repeated[refs[i].block][refs[i].element] = true;
    }
  }
  return is_repeated;
}

}  // namespace

Cells take_cells(const Source& source,
                 const Contents& contents,
                 const NodeNumbers& numbers,
                 Mesh& mesh) {
  const auto is_repeated = repetitions(source, contents, mesh.dimension);
  Cells cells;
  mesh.cell_offsets.push_back(0);
  for (size_t b = 0; b < contents.blocks.size(); ++b) {
    const ElementBlock& block = contents.blocks[b];
    if (block.dimension != mesh.dimension) continue;
    for (size_t i = 0; i < block.tags.size(); ++i) {
      if (is_repeated[b][i]) continue;
      mesh.cell_types.push_back(cell_type(block.type));
      for (int k = 0; k < block.n_nodes; ++k) {
        mesh.cell_nodes.push_back(numbers.index_of(block.nodes[i * block.n_nodes + k]));
      }
      mesh.cell_offsets.push_back(static_cast<std::int64_t>(mesh.cell_nodes.size()));
      cells.tags.push_back(block.tags[i]);
      cells.places.push_back(block.places[i]);
    }
  }
  return cells;
}

}  // namespace diptych::meshes::msh
