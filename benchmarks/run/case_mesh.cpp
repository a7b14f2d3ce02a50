#include "benchmarks/run/case_mesh.hpp"

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "meshes/generators.hpp"
#include "meshes/gmsh.hpp"
#include "meshes/renumber.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <numeric>

namespace diptych::harness {

namespace {

meshes::Mesh box_of(const cases::MeshCase& box, int level) {
  std::array<int, 3> cells = box.cells;
  for (int& n : cells) {
    if ((static_cast<std::int64_t>(n) << level) > 1'000'000) {
      throw base::InputError(fmt::format(
          "level {} of {} cells along a side is out of reach; use a smaller --level", level, n));
    }
    n <<= level;
  }
  return meshes::box(meshes::cell_menu().at(box.element), box.lower, box.upper, cells);
}

/// Removes a folder at the end of a scope; one that cannot be removed is left behind.
struct Removal {
  std::filesystem::path folder;
  ~Removal() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
};

/// A new folder of this process alone: another one may be meshing the same file, and a name that
/// can be guessed may be somebody else's already.
std::filesystem::path new_folder(const std::string& work_directory) {
  std::error_code error;
  const std::filesystem::path above = work_directory.empty()
                                          ? std::filesystem::temp_directory_path(error)
                                          : std::filesystem::path(work_directory);
  if (error) {
    const char* named = std::getenv("TMPDIR");
    throw base::EnvironmentError(
        fmt::format("the folder for temporary files{} cannot be used: {}; set TMPDIR to one that "
                    "you may write to",
                    named != nullptr ? fmt::format(" (TMPDIR = {})", named) : "", error.message()));
  }
  std::string name = (above / "diptych-mesh-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw base::EnvironmentError(
        fmt::format("{}: no folder for the mesh can be made there: {}; set TMPDIR to one that you "
                    "may write to",
                    above.string(), std::strerror(errno)));
  }
  return name;
}

/// A file may mix cells; prisms have no name that a case could give.
void check_element(const cases::Case& setup, const meshes::Mesh& mesh) {
  const auto& menu = meshes::cell_menu();
  const auto has = [&](const std::string& name) {
    const auto& types = mesh.cell_types;
    return std::find(types.begin(), types.end(), menu.at(name)) != types.end();
  };
  if (has(setup.mesh.element)) return;
  for (const std::string& name : menu.names()) {
    if (!has(name)) continue;
    throw base::InputError(
        fmt::format("{}: mesh.element = \"{}\", but '{}' has no such cells: its own are of type "
                    "{}; write mesh.element = \"{}\"",
                    setup.file, setup.mesh.element, setup.mesh.file, name, name));
  }
  if (mesh.dimension == cases::dimension_of(setup.mesh)) return;
  throw base::InputError(fmt::format(
      "{}: mesh.element = \"{}\" makes the case {}-D, but the cells of '{}' are {}-D; give an "
      "element of theirs",
      setup.file, setup.mesh.element, cases::dimension_of(setup.mesh), setup.mesh.file,
      mesh.dimension));
}

meshes::Mesh file_mesh(const cases::Case& setup, int level, const std::string& work_directory) {
  const std::filesystem::path path = setup.mesh.file;
  if (!std::filesystem::exists(path)) {
    throw base::InputError(
        fmt::format("{}: mesh.file '{}' does not exist", setup.file, path.string()));
  }
  if (path.extension() == ".geo") {
    const std::filesystem::path folder = new_folder(work_directory);
    const Removal removal{folder};
    return meshes::mesh_geo(path.string(), cases::dimension_of(setup.mesh),
                            std::ldexp(setup.mesh.size, -level), folder.string());
  }
  if (level != 0) {
    throw base::InputError(fmt::format(
        "{}: a .msh file has one level; give a .geo file and mesh.size to refine, or use --level 0",
        path.string()));
  }
  return meshes::read_msh(path.string());
}

}  // namespace

void check_level(int level) {
  if (level >= 0 && level <= greatest_level) return;
  throw base::InputError(fmt::format(
      "--level {}: levels go from 0 to {}; each divides the spacing by 2", level, greatest_level));
}

void check_levels(int first, int n) {
  check_level(first);
  if (n <= greatest_level + 1 - first) return;
  throw base::InputError(
      fmt::format("--levels {} from level {} on: levels go from 0 to {}; use at most --levels {}",
                  n, first, greatest_level, greatest_level + 1 - first));
}

CaseMesh mesh_of(const cases::Case& setup, int level, const std::string& work_directory) {
  check_level(level);
  CaseMesh result;
  if (setup.mesh.file.empty()) {
    result.mesh = box_of(setup.mesh, level);
  } else {
    result.mesh = file_mesh(setup, level, work_directory);
    check_element(setup, result.mesh);
  }
  if (setup.mesh.perturbation > 0) {
    meshes::perturb_interior(result.mesh, setup.mesh.perturbation, setup.mesh.seed + level);
  }
  meshes::check_cells(result.mesh, setup.mesh.file.empty() ? setup.name : setup.mesh.file);
  if (setup.mesh.file.empty()) {
    result.order.resize(result.mesh.nodes.size());
    std::iota(result.order.begin(), result.order.end(), 0);
  } else {
    result.order = meshes::rcm_order(result.mesh);
    result.mesh = meshes::renumbered(result.mesh, result.order);
  }
  return result;
}

io::VisualMesh visual_mesh(const CaseMesh& mesh) {
  static const std::map<meshes::CellType, std::uint8_t> vtk_type{
      {meshes::CellType::triangle, 5},
      {meshes::CellType::quadrilateral, 9},
      {meshes::CellType::tetrahedron, 10},
      {meshes::CellType::hexahedron, 12},
      {meshes::CellType::prism, 13}};
  io::VisualMesh visual;
  visual.points.resize(3 * mesh.mesh.nodes.size());
  for (size_t a = 0; a < mesh.mesh.nodes.size(); ++a) {
    for (int i = 0; i < 3; ++i)
      visual.points[3 * mesh.order[a] + i] = mesh.mesh.nodes[a][i];
  }
  // VTK looks at the base of a wedge from outside (normal of 0, 1, 2 away from 3, 4, 5), Gmsh from
  // inside; all other types agree
  static constexpr int as_they_are[] = {0, 1, 2, 3, 4, 5, 6, 7}, of_prism[] = {0, 2, 1, 3, 5, 4};
  for (std::int64_t c = 0; c < mesh.mesh.n_cells(); ++c) {
    const auto nodes = mesh.mesh.cell(c);
    const int* local = mesh.mesh.cell_types[c] == meshes::CellType::prism ? of_prism : as_they_are;
    for (size_t i = 0; i < nodes.size(); ++i)
      visual.connectivity.push_back(mesh.order[nodes[local[i]]]);
  }
  visual.offsets.assign(mesh.mesh.cell_offsets.begin(), mesh.mesh.cell_offsets.end());
  for (const meshes::CellType type : mesh.mesh.cell_types) {
    visual.types.push_back(vtk_type.at(type));
  }
  return visual;
}

}  // namespace diptych::harness
