#pragma once
/// What a .msh file says, of either version, before it becomes a mesh: tags as in the file, nothing
/// resolved. The parsers fill it (format.cpp and version_*.cpp), assembly.cpp reads it.

#include "meshes/mesh.hpp"
#include "meshes/msh/source.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace diptych::meshes::msh {

/// Dimension and tag: of a physical group, or of a geometric entity.
using Key = std::pair<int, int>;

struct PhysicalName {
  std::string name;
  std::int64_t place = 0;  ///< in the file
};

/// Elements of one type that share an entity.
struct ElementBlock {
  int type = 0;                      ///< Gmsh's number
  int dimension = 0;                 ///< of the type
  int n_nodes = 0;                   ///< per element
  Key entity{};                      ///< dimension of the entity and its tag
  std::vector<int> physical_tags;    ///< version 2.2: of these elements, at most one
  std::vector<std::int64_t> tags;    // [n_elements]
  std::vector<std::int64_t> places;  // [n_elements] line or byte offset
  std::vector<std::int64_t> nodes;   // [n_elements][n_nodes] node tags
};

struct Contents {
  bool is_version_4 = false;
  std::map<Key, PhysicalName> physical_names;
  bool has_entities = false;                      ///< version 4.1, optional there
  std::map<Key, std::vector<int>> physical_tags;  ///< of each entity, version 4.1
  std::vector<std::int64_t> node_tags;            // [n_nodes]
  std::vector<Vec3> node_places;                  // [n_nodes] m
  std::vector<ElementBlock> blocks;
};

/// Gmsh's element types that can be read: points and lines (boundaries of 2-D meshes) too.
struct ElementType {
  int dimension = 0;
  int n_nodes = 0;
};
/// @throws base::InputError naming pyramids, higher-order and other types
ElementType element_type(const Source& source, int type, std::int64_t tag);
/// The cell type of a Gmsh element type of dimension 2 or 3.
CellType cell_type(int type);

Contents read_contents(Source& source);

/// Bodies of the sections, from behind "$Nodes" to before "$EndNodes".
void read_entities_4(Source& source, Contents& contents);
void read_nodes_4(Source& source, Contents& contents);
void read_elements_4(Source& source, Contents& contents);
void read_nodes_2(Source& source, Contents& contents);
void read_elements_2(Source& source, Contents& contents);

/// Builds and checks the mesh.
Mesh assembled(const Source& source, Contents contents);

/// read_msh of a file that is in memory already.
Mesh read_msh_bytes(std::string bytes, const std::string& name);

}  // namespace diptych::meshes::msh
