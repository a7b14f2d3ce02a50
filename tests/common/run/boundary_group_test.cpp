/// Groups of a case that have faces in common, or a kink: loads and probes on each face once.

#include "common/run/boundary_group.hpp"

#include "common/run/probes.hpp"
#include "meshes/united_groups.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace diptych {
namespace {

using algebra::Vec3;

const char* const block = R"([mesh]
element = "hexahedron"
cells = [6, 6, 6]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[[boundary]]
group = GROUPS
type = "traction"
value = ["1e3", 0, 0]
[time]
end = 1e-6
[[probe]]
name = "area"
unit = "m^2"
kind = "integral"
group = GROUPS
quantity = "1"
)";

cases::Case case_on(const std::string& groups) {
  std::string text = block;
  for (size_t at = 0; (at = text.find("GROUPS")) != std::string::npos;)
    text.replace(at, 6, groups);
  return cases::case_from_text(text, "block", {});
}

/// A cube with a group of half of a side and half of the next, and one of all sides.
meshes::Mesh cube() {
  meshes::Mesh mesh = meshes::box(meshes::CellType::hexahedron, {0, 0, 0}, {1, 1, 1}, {6, 6, 6});
  meshes::BoundaryGroup part{"part", {}}, all{"all", {}};
  for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
    all.faces.push_back(static_cast<std::int32_t>(f));
    bool is_in = true;
    for (const std::int32_t a : mesh.boundary_faces[f].nodes)
      is_in &= mesh.nodes[a].z() < 0.51;
    const auto on = [&](const char* side) {
      const auto& faces = mesh.group(side).faces;
      return std::find(faces.begin(), faces.end(), static_cast<std::int32_t>(f)) != faces.end();
    };
    if (is_in && (on("x_max") || on("y_max"))) part.faces.push_back(static_cast<std::int32_t>(f));
  }
  mesh.boundary_groups.insert(mesh.boundary_groups.end(), {part, all});
  return mesh;
}

class LoadedGroups : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Both, LoadedGroups, testing::Values("sph", "fvm"));

TEST_P(LoadedGroups, HaveTheForceAndTheAreaOfTheirFaces) {
  const std::pair<const char*, double> loaded[] = {
      {R"(["x_max"])", 1},         {R"(["part"])", 1},
      {R"(["all"])", 6},           {R"(["x_max", "part"])", 1.5},
      {R"(["part", "z_min"])", 2}, {R"(["part", "all", "z_min"])", 6}};
  for (const auto& [groups, area] : loaded) {
    cases::Case setup = case_on(groups);
    setup.fvm.stencil = "edge";  // groups may end anywhere
    setup.sph.gradient = "corrected";
    meshes::Mesh mesh = cube();
    meshes::unite_overlapping(setup.boundaries[0].groups, mesh);
    const scheme::PairGraph graph = tests::graph_of(GetParam(), mesh, setup);
    const auto solver = run::make_solver(setup, graph);
    const run::Probes probes(setup.probes, graph, {});
    EXPECT_NEAR(probes.values(*solver).at(0), area, 1e-12) << groups;
    solver->step(setup.time.end);
    const run::Snapshot after = solver->snapshot();
    double momentum = 0;
    for (size_t a = 0; a < graph.X.size(); ++a)
      momentum += 1000 * graph.Omega[a] * after.v[a].x();
    EXPECT_NEAR(momentum, 1e3 * area * solver->time(), 1e-9 * momentum) << groups;
  }
}

TEST(NamedGroups, AreThemselvesWhereTheyShareNoFace) {
  const scheme::PairGraph graph = tests::graph_of("fvm", cube());
  const auto patches = run::patches_with_each_face_once(graph, {"x_max", "y_max"}, {});
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_EQ(patches[1], &run::boundary_group(graph, "y_max", {}));
}

}  // namespace
}  // namespace diptych
