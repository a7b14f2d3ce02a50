#include "common/cases/reader.hpp"
#include "common/cases/sections/sections.hpp"
#include "meshes/generators.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace diptych::cases {

namespace {

void check_mesh_file(const SectionValues& section,
                     const std::filesystem::path& folder,
                     MeshCase& mesh) {
  namespace fs = std::filesystem;
  mesh.generator.clear();
  if (!section.has("element")) {
    section.fail("element",
                 "is missing; with mesh.file it tells whether the case is 2-D (triangle, "
                 "quadrilateral) or 3-D (tetrahedron, hexahedron)");
  }
  for (const char* name : {"lower", "upper", "cells"})
    section.refuse(name, "has no effect with mesh.file; remove one of the two");
  const std::string file = mesh.file;
  const fs::path path = (folder / file).lexically_normal();
  const std::string extension = path.extension().string();
  if (extension != ".msh" && extension != ".geo")
    section.fail("file", fmt::format("= '{}' is neither a .msh nor a .geo file", shown(file)));
  std::error_code ignored;  // a file that cannot be seen is not there
  if (!fs::is_regular_file(path, ignored))
    section.fail("file", fmt::format("= '{}' does not exist: {}", shown(file), path.string()));
  mesh.file = path.string();
  if (extension == ".geo") mesh.size = section.number("size");
  if (extension == ".msh") section.refuse("size", "has no effect on a .msh file; remove it");
}

void check_box(const SectionValues& section, int dimension, MeshCase& mesh) {
  section.refuse("size", "has no effect on a box; use cells");
  if (dimension == 2) mesh.lower[2] = mesh.upper[2] = 0;
  const std::vector<std::int64_t> cells = section.counts("cells");
  double n_cells = 1;
  mesh.cells = {1, 1, 1};
  for (int i = 0; i < dimension; ++i) {
    if (!(mesh.lower[i] < mesh.upper[i])) {
      section.fail(section.has("upper") ? "upper" : "lower",
                   fmt::format("leaves no box: {} to {} in direction {}; upper must exceed lower",
                               mesh.lower[i], mesh.upper[i], "xyz"[i]));
    }
    mesh.cells[static_cast<size_t>(i)] = static_cast<int>(cells[static_cast<size_t>(i)]);
    n_cells *= static_cast<double>(cells[static_cast<size_t>(i)]);
  }
  if (n_cells > 2e9) {
    section.fail("cells", fmt::format("makes {:.3g} cells; nodes are counted in 32 bits, so the "
                                      "most is 2e9",
                                      n_cells));
  }
}

SectionKeys<MeshCase> mesh_keys() {
  return SectionKeys<MeshCase>("mesh")
      .key("element", &MeshCase::element,
           with_default(one_of(
               meshes::cell_menu().names(),
               "Cell type; the last two make the case 2-D (plane strain; energies, forces and "
               "momenta are those of a slice one metre thick), and then "
               "all vectors have two entries. A mesh file must have such cells.",
               "\"tetrahedron\"", "required with mesh.file")))
      .key("file", &MeshCase::file,
           optional(
               as(KeyType::path,
                  {"-", any,
                   "Mesh to read (.msh) or to make with gmsh (.geo), relative to the case file.",
                   "\"column.geo\"", "optional, instead of a box"})))
      .key("lower", &MeshCase::lower, {"m", any, "Lower corner of the box.", "[-0.5, -0.5, 0]"})
      .key("upper", &MeshCase::upper, {"m", any, "Upper corner of the box.", "[0.5, 0.5, 6]"})
      .key("cells", KeyType::counts,
           {"-", between(1, 1e6),
            "Cells in each direction at level 0; level L has 2^L times as many.", "[4, 4, 24]",
            "required for a box"})
      .key("size", KeyType::number,
           {"m", above(0),
            "Element size at level 0; level L has size / 2^L. The file takes it as h: "
            "DefineConstant[ h = 0.1 ];",
            "0.1", "required for a .geo file"})
      .key("perturbation", &MeshCase::perturbation,
           {"-", Range{0, 0.5, true, false},
            "Random shift of interior nodes as a fraction of the local spacing.", "0.2"})
      .key("seed", &MeshCase::seed,
           {"-", at_least(0),
            "Seed of the random shift; the same seed gives the same mesh everywhere.", "7"});
}

}  // namespace

SectionEntry mesh_section() {
  const auto keys = mesh_keys();
  return {{"mesh", false, "The body: a box made here, or a mesh file."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            const SectionValues section = reading.section("mesh");
            MeshCase& mesh = setup.mesh;
            // all vectors of the case, those of this section among them, have its dimension
            if (section.has("element")) mesh.element = section.menu_name("element");
            reading.dimension = dimension_of(mesh);
            mesh = keys.read(section);
            if (section.has("file")) {
              check_mesh_file(section, reading.folder, mesh);
            } else {
              check_box(section, reading.dimension, mesh);
            }
            if (!section.has("perturbation"))
              section.refuse("seed", "has no effect without mesh.perturbation; remove it");
          }};
}

}  // namespace diptych::cases
