/// Sections of version 2.2. Counts are text in both modes; binary elements stand in blocks of one
/// type. An element that lies in several physical groups stands once per group.

#include "meshes/msh/contents.hpp"

#include <cstdlib>
#include <fmt/format.h>

namespace diptych::meshes::msh {

namespace {

constexpr std::int64_t n_bytes_integer = 4, n_bytes_real = 8;

/// Type and tags decide the block an element belongs to.
struct ElementHead {
  int type = 0;
  int physical = 0;
  int entity = 0;
};

ElementBlock& block_for(const Source& source,
                        const ElementHead& head,
                        std::int64_t tag,
                        std::map<std::array<int, 3>, size_t>& index,
                        Contents& contents) {
  const std::array<int, 3> key{head.type, head.physical, head.entity};
  const auto [found, is_new] = index.emplace(key, contents.blocks.size());
  if (is_new) {
    const ElementType type = element_type(source, head.type, tag);
    ElementBlock block;
    block.type = head.type;
    block.dimension = type.dimension;
    block.n_nodes = type.n_nodes;
    block.entity = {type.dimension, head.entity};
    if (head.physical != 0) block.physical_tags = {head.physical};
    contents.blocks.push_back(std::move(block));
  }
  return contents.blocks[found->second];
}

/// Tags of an element: physical group (its sign is an orientation), entity, partitions.
void read_tags(Source& source, int n_tags, ElementHead& head) {
  head.physical = head.entity = 0;
  for (int i = 0; i < n_tags; ++i) {
    const int tag = source.integer("a tag of an element");
    if (i > 1) continue;
    if (tag == INT32_MIN) source.fail(fmt::format("tag {} of an element is not valid", tag));
    (i == 0 ? head.physical : head.entity) = i == 0 ? std::abs(tag) : tag;
  }
}

int checked_tag_count(const Source& source, int n_tags) {
  source.check_count(n_tags, 1, n_bytes_integer, "the number of tags");
  return n_tags;
}

}  // namespace

void read_nodes_2(Source& source, Contents& contents) {
  const std::int64_t n_nodes = source.text_integer("the number of nodes");
  source.check_count(n_nodes, 4, n_bytes_integer + 3 * n_bytes_real, "the number of nodes");
  if (source.is_binary()) source.end_of_line_before_block();
  contents.node_tags.reserve(n_nodes);
  contents.node_places.reserve(n_nodes);
  for (std::int64_t i = 0; i < n_nodes; ++i) {
    const int tag = source.integer("a node number");
    if (tag < 1) source.fail(fmt::format("node number {} must be positive", tag));
    const double x = source.finite_real("coordinate x");
    const double y = source.finite_real("coordinate y");
    const double z = source.finite_real("coordinate z");
    contents.node_tags.push_back(tag);
    contents.node_places.emplace_back(x, y, z);
  }
}

void read_elements_2(Source& source, Contents& contents) {
  const std::int64_t n_elements = source.text_integer("the number of elements");
  source.check_count(n_elements, 4, 2 * n_bytes_integer, "the number of elements");
  if (source.is_binary()) source.end_of_line_before_block();
  std::map<std::array<int, 3>, size_t> index;
  std::int64_t n_in_block = 0;  // binary: still to come in this block
  ElementHead head;
  int n_tags = 0;
  for (std::int64_t i = 0; i < n_elements; ++i, --n_in_block) {
    if (source.is_binary() && n_in_block == 0) {
      head.type = source.integer("the type of a block");
      n_in_block = source.integer("the number of elements of a block");
      if (n_in_block < 1 || n_in_block > n_elements - i) {
        source.fail(
            fmt::format("a block of {} elements where {} are left", n_in_block, n_elements - i));
      }
      n_tags = checked_tag_count(source, source.integer("the number of tags"));
    }
    const int tag = source.integer("an element number");
    const std::int64_t place = source.place();
    if (!source.is_binary()) {
      head.type = source.integer("the type of an element");
      n_tags = checked_tag_count(source, source.integer("the number of tags"));
    }
    read_tags(source, n_tags, head);
    ElementBlock& block = block_for(source, head, tag, index, contents);
    block.tags.push_back(tag);
    block.places.push_back(place);
    for (int k = 0; k < block.n_nodes; ++k)
      block.nodes.push_back(source.integer("a node number"));
  }
}

}  // namespace diptych::meshes::msh
