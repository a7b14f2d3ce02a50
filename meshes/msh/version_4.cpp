/// Sections of version 4.1. Numbers stand in the same order in ASCII and binary.

#include "meshes/msh/contents.hpp"

#include <cstdlib>
#include <fmt/format.h>

namespace diptych::meshes::msh {

namespace {

constexpr std::int64_t n_bytes_integer = 4, n_bytes_size = 8, n_bytes_real = 8;

void read_entity(Source& source, int dimension, Contents& contents) {
  const int tag = source.integer("an entity tag");
  const int n_reals = dimension == 0 ? 3 : 6;
  for (int i = 0; i < n_reals; ++i)
    source.real("a bound of an entity");
  const std::int64_t n_physical = source.size("the number of physical tags");
  source.check_count(n_physical, 1, n_bytes_integer, "the number of physical tags");
  std::vector<int> tags;
  for (std::int64_t i = 0; i < n_physical; ++i) {
    const int physical = source.integer("a physical tag");
    // The sign says how the entity is oriented in the group; faces are oriented by their cells.
    if (physical == 0 || physical == INT32_MIN) {
      source.fail(fmt::format("physical tag {} of entity {} is not valid", physical, tag));
    }
    tags.push_back(std::abs(physical));
  }
  if (!contents.physical_tags.emplace(Key{dimension, tag}, std::move(tags)).second) {
    source.fail(fmt::format("entity {} of dimension {} stands twice", tag, dimension));
  }
  if (dimension == 0) return;
  const std::int64_t n_bounding = source.size("the number of bounding entities");
  source.check_count(n_bounding, 1, n_bytes_integer, "the number of bounding entities");
  for (std::int64_t i = 0; i < n_bounding; ++i)
    source.integer("a bounding entity");
}

struct BlockHeader {
  int dimension;
  int entity;
  int third;  ///< nodes: whether parametric; elements: type
  std::int64_t count;
};

BlockHeader read_block_header(Source& source, const char* third, const char* count) {
  BlockHeader header{};
  header.dimension = source.integer("the dimension of an entity");
  if (header.dimension < 0 || header.dimension > 3) {
    source.fail(fmt::format("dimension {} of an entity is not 0, 1, 2 or 3", header.dimension));
  }
  header.entity = source.integer("an entity tag");
  header.third = source.integer(third);
  header.count = source.size(count);
  return header;
}

void check_total(const Source& source,
                 std::int64_t found,
                 std::int64_t announced,
                 const char* what) {
  if (found == announced) return;
  source.fail(fmt::format("{} {} are announced, but the blocks hold {}", announced, what, found));
}

/// Four numbers at the head of $Nodes and $Elements; the least and greatest tag are not needed.
std::pair<std::int64_t, std::int64_t> read_section_head(Source& source,
                                                        const char* what,
                                                        std::int64_t n_bytes_item) {
  const std::int64_t n_blocks = source.size("the number of entity blocks");
  source.check_count(n_blocks, 4, 3 * n_bytes_integer + n_bytes_size,
                     "the number of entity blocks");
  const std::int64_t n_items = source.size(what);
  source.check_count(n_items, 2, n_bytes_item, what);
  source.size("the least tag");
  source.size("the greatest tag");
  return {n_blocks, n_items};
}

}  // namespace

void read_entities_4(Source& source, Contents& contents) {
  contents.has_entities = true;
  std::int64_t n_entities[4];
  for (std::int64_t& n : n_entities) {
    n = source.size("the number of entities");
    source.check_count(n, 5, n_bytes_integer + 3 * n_bytes_real + n_bytes_size,
                       "the number of entities");
  }
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::int64_t i = 0; i < n_entities[dimension]; ++i) {
      read_entity(source, dimension, contents);
    }
  }
}

void read_nodes_4(Source& source, Contents& contents) {
  const auto [n_blocks, n_nodes] =
      read_section_head(source, "the number of nodes", n_bytes_size + 3 * n_bytes_real);
  contents.node_tags.reserve(n_nodes);
  contents.node_places.reserve(n_nodes);
  for (std::int64_t b = 0; b < n_blocks; ++b) {
    const BlockHeader header =
        read_block_header(source, "the parametric mark", "the number of nodes of a block");
    if (header.third != 0 && header.third != 1) {
      source.fail(fmt::format("parametric mark {} is neither 0 nor 1", header.third));
    }
    source.check_count(header.count, 4, n_bytes_size + 3 * n_bytes_real,
                       "the number of nodes of a block");
    for (std::int64_t i = 0; i < header.count; ++i) {
      contents.node_tags.push_back(source.size("a node tag"));
      if (contents.node_tags.back() == 0) source.fail("node tag 0 is not valid");
    }
    for (std::int64_t i = 0; i < header.count; ++i) {
      const double x = source.finite_real("coordinate x");
      const double y = source.finite_real("coordinate y");
      const double z = source.finite_real("coordinate z");
      contents.node_places.emplace_back(x, y, z);
      for (int k = 0; k < header.third * header.dimension; ++k)
        source.real("a parameter");
    }
  }
  check_total(source, static_cast<std::int64_t>(contents.node_tags.size()), n_nodes, "nodes");
}

void read_elements_4(Source& source, Contents& contents) {
  const auto [n_blocks, n_elements] =
      read_section_head(source, "the number of elements", 2 * n_bytes_size);
  std::int64_t n_found = 0;
  for (std::int64_t b = 0; b < n_blocks; ++b) {
    const BlockHeader header =
        read_block_header(source, "the type of a block", "the number of elements of a block");
    if (header.count == 0) continue;
    const ElementType type = element_type(source, header.third, 0);
    if (type.dimension != header.dimension) {
      source.fail(fmt::format("elements of type {} (dimension {}) in an entity of dimension {}",
                              header.third, type.dimension, header.dimension));
    }
    source.check_count(header.count, type.n_nodes + 1, (type.n_nodes + 1) * n_bytes_size,
                       "the number of elements of a block");
    ElementBlock block;
    block.type = header.third;
    block.dimension = type.dimension;
    block.n_nodes = type.n_nodes;
    block.entity = {header.dimension, header.entity};
    if (contents.has_entities && !contents.physical_tags.contains(block.entity)) {
      source.fail(fmt::format("elements of entity {} of dimension {}, which $Entities lacks",
                              header.entity, header.dimension));
    }
    block.tags.reserve(header.count);
    block.places.reserve(header.count);
    block.nodes.reserve(header.count * type.n_nodes);
    for (std::int64_t i = 0; i < header.count; ++i) {
      block.tags.push_back(source.size("an element tag"));
      block.places.push_back(source.place());
      for (int k = 0; k < type.n_nodes; ++k)
        block.nodes.push_back(source.size("a node tag"));
    }
    n_found += header.count;
    contents.blocks.push_back(std::move(block));
  }
  check_total(source, n_found, n_elements, "elements");
}

}  // namespace diptych::meshes::msh
