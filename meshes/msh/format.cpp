/// The frame of a .msh file: header, sections, physical names (the same in both versions), element
/// types. Format: Gmsh reference manual, chapter "File formats". Sections that carry no mesh
/// ($Periodic, $NodeData, $Comments, ...) are skipped, as the format asks.
/// Test: tests/meshes/msh_reader_test.cpp, msh_malformed_test.cpp.

#include "meshes/gmsh.hpp"
#include "meshes/msh/contents.hpp"

#include <bit>
#include <fmt/format.h>
#include <set>

namespace diptych::meshes::msh {

namespace {

enum class Version { two, four };

Version read_version(Source& source) {
  const double version = source.text_real("the version");
  if (version == 4.1) return Version::four;
  if (version == 2.2) return Version::two;
  source.fail(
      fmt::format("version {} of the format is not supported, only 4.1 and 2.2: save the "
                  "mesh again with gmsh -save -format msh41",
                  version));
}

void read_endianness(Source& source) {
  source.end_of_line_before_block();
  const auto one = static_cast<std::uint32_t>(source.raw_integer("the byte order mark"));
  if (one == 1) return;
  if (one == 0x01000000) {
    source.fail("the file was written on a machine with the other byte order: save it as ASCII");
  }
  source.fail(
      fmt::format("the byte order mark is {}, not 1: is the file ASCII, or was it changed "
                  "by a text transfer?",
                  one));
}

Version read_header(Source& source) {
  if (source.at_end()) source.fail("the file is empty");
  if (const auto first = source.word("$MeshFormat"); first != "$MeshFormat") {
    source.fail(
        fmt::format("a Gmsh .msh file begins with $MeshFormat, not with '{}'", shown(first)));
  }
  source.enter("$MeshFormat");
  const Version version = read_version(source);
  const std::int64_t mode = source.text_integer("the file type");
  if (mode != 0 && mode != 1) {
    source.fail(fmt::format("file type {} is neither 0 (ASCII) nor 1 (binary)", mode));
  }
  const std::int64_t n_bytes = source.text_integer("the data size");
  if (n_bytes != 8) {
    source.fail(fmt::format("data size {} is not supported, only 8 (64-bit Gmsh)", n_bytes));
  }
  if (mode == 1) {
    source.set_binary();
    read_endianness(source);
  }
  source.expect("$EndMeshFormat");
  return version;
}

/// From behind the tag to the line end: a name in double quotes, of any printable bytes.
std::string read_quoted_name(Source& source) {
  const std::string_view line = source.rest_of_line();
  const size_t first = line.find('"'), last = line.rfind('"');
  if (first == std::string_view::npos || last == first || line.find_first_not_of(" \t") != first ||
      line.find_first_not_of(" \t", last + 1) != std::string_view::npos) {
    source.fail(fmt::format("a physical name in double quotes is needed, not '{}'", shown(line)));
  }
  const std::string_view name = line.substr(first + 1, last - first - 1);
  if (name.empty()) source.fail("a physical name is empty");
  for (const char c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      source.fail(fmt::format("physical name '{}' has a control character", shown(name)));
    }
  }
  return std::string(name);
}

/// ASCII even in binary files.
void read_physical_names(Source& source, Contents& contents) {
  const std::int64_t n_names = source.text_integer("the number of physical names");
  std::set<std::pair<int, std::string>> seen;
  for (std::int64_t i = 0; i < n_names; ++i) {
    const std::int64_t dimension = source.text_integer("the dimension of a physical name");
    const std::int64_t tag = source.text_integer("the tag of a physical name");
    if (dimension < 0 || dimension > 3) {
      source.fail(fmt::format("dimension {} of a physical name is not 0, 1, 2 or 3", dimension));
    }
    if (tag < 1 || tag > INT32_MAX) {
      source.fail(fmt::format("tag {} of a physical name is not a positive 32-bit number", tag));
    }
    const std::int64_t place = source.place();
    std::string name = read_quoted_name(source);
    const Key key{static_cast<int>(dimension), static_cast<int>(tag)};
    if (!seen.insert({key.first, name}).second) {
      source.fail(fmt::format("physical name '{}' is given twice", name));
    }
    if (!contents.physical_names.emplace(key, PhysicalName{std::move(name), place}).second) {
      source.fail(fmt::format("physical tag {} has two names", tag));
    }
  }
}

/// One section, from behind its first word to behind its last.
void read_section(Source& source, const std::string& section, Version version, Contents& contents) {
  const bool is_4 = version == Version::four;
  if (section == "$PhysicalNames") {
    read_physical_names(source, contents);
  } else if (section == "$Entities" && is_4) {
    if (source.is_binary()) source.end_of_line_before_block();
    read_entities_4(source, contents);
  } else if (section == "$Nodes") {
    if (is_4 && source.is_binary()) source.end_of_line_before_block();
    is_4 ? read_nodes_4(source, contents) : read_nodes_2(source, contents);
  } else if (section == "$Elements") {
    if (is_4 && source.is_binary()) source.end_of_line_before_block();
    is_4 ? read_elements_4(source, contents) : read_elements_2(source, contents);
  } else if (section == "$PartitionedEntities" || section == "$GhostElements") {
    source.fail("partitioned meshes are not supported: save the mesh unpartitioned");
  } else {
    source.skip_behind("$End" + section.substr(1));
    return;
  }
  source.expect("$End" + section.substr(1));
}

std::string higher_order_name(int type) {
  switch (type) {
    case 8:
      return "second-order line";
    case 9:
    case 20:
    case 21:
    case 22:
    case 23:
    case 24:
    case 25:
      return "higher-order triangle";
    case 10:
    case 16:
      return "second-order quadrilateral";
    case 11:
      return "second-order tetrahedron";
    case 12:
    case 17:
      return "second-order hexahedron";
    case 13:
    case 18:
      return "second-order prism";
    case 14:
    case 19:
      return "second-order pyramid";
    default:
      return {};
  }
}

}  // namespace

ElementType element_type(const Source& source, int type, std::int64_t tag) {
  switch (type) {
    case 15:
      return {0, 1};
    case 1:
      return {1, 2};
    case 2:
      return {2, 3};
    case 3:
      return {2, 4};
    case 4:
      return {3, 4};
    case 5:
      return {3, 8};
    case 6:
      return {3, 6};
    default:
      break;
  }
  const std::string element = tag > 0 ? fmt::format("element {}", tag) : "an element";
  if (type == 7) {
    source.fail(
        fmt::format("{} is a pyramid (type 7), which is not supported: mesh with "
                    "tetrahedra, prisms or hexahedra only",
                    element));
  }
  if (const std::string name = higher_order_name(type); !name.empty()) {
    source.fail(
        fmt::format("{} is a {} (type {}): only first-order elements are supported, mesh "
                    "with Mesh.ElementOrder = 1",
                    element, name, type));
  }
  source.fail(
      fmt::format("{} has type {}, which is not supported: first-order triangles, "
                  "quadrilaterals, tetrahedra, hexahedra and prisms are",
                  element, type));
}

CellType cell_type(int type) {
  constexpr CellType types[] = {CellType::triangle, CellType::quadrilateral, CellType::tetrahedron,
                                CellType::hexahedron, CellType::prism};
  return types[type - 2];  // Gmsh's 2 to 6
}

Contents read_contents(Source& source) {
  static_assert(std::endian::native == std::endian::little, "binary blocks are read as they stand");
  Contents contents;
  const Version version = read_header(source);
  contents.is_version_4 = version == Version::four;
  std::set<std::string> seen;
  source.enter("");
  while (!source.at_end()) {
    const std::string section(source.word("a section"));
    if (section.size() < 2 || section[0] != '$' || section.starts_with("$End")) {
      source.fail(fmt::format("a section ($Nodes, ...) is needed, not '{}'", shown(section)));
    }
    source.enter(shown(section));
    const bool is_mesh = section == "$Nodes" || section == "$Elements" ||
                         section == "$PhysicalNames" || section == "$Entities";
    if (is_mesh && !seen.insert(section).second) source.fail("the section stands twice");
    read_section(source, section, version, contents);
    source.enter("");
  }
  for (const char* needed : {"$Nodes", "$Elements"}) {
    if (!seen.contains(needed)) {
      source.fail(fmt::format("the file has no {} section (truncated?)", needed));
    }
  }
  return contents;
}

Mesh read_msh_bytes(std::string bytes, const std::string& name) {
  Source source(std::move(bytes), name);
  Contents contents = read_contents(source);
  return assembled(source, std::move(contents));
}

}  // namespace diptych::meshes::msh

namespace diptych::meshes {

Mesh read_msh(const std::string& path) {
  return msh::read_msh_bytes(msh::file_bytes(path), path);
}

}  // namespace diptych::meshes
