#include "benchmarks/run/scene.hpp"

#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/mesh_notices.hpp"
#include "benchmarks/run/unseen_fields.hpp"
#include "benchmarks/run/wall_directions.hpp"
#include "common/cases/reader.hpp"
#include "common/run/step_ends.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "meshes/united_groups.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace diptych::harness {

namespace {

/// What loads and areas of probes take each face of once.
void unite_overlapping_groups(const cases::Case& setup, meshes::Mesh& mesh) {
  for (const cases::BoundaryCase& boundary : setup.boundaries)
    meshes::unite_overlapping(boundary.groups, mesh);
  for (const cases::ProbeCase& probe : setup.probes)
    meshes::unite_overlapping(probe.groups, mesh);
}

/// A probe of a force that nothing exerts.
void note_idle_reactions(const cases::Case& setup,
                         const meshes::Mesh& mesh,
                         std::vector<std::string>& notices) {
  const auto for_nodes = [&](const std::vector<std::string>& names, const auto& use) {
    for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
      if (std::find(names.begin(), names.end(), group.name) == names.end()) continue;
      for (const std::int32_t f : group.faces) {
        const meshes::BoundaryFace& face = mesh.boundary_faces[static_cast<size_t>(f)];
        std::for_each_n(face.nodes.begin(), face.n_nodes, use);
      }
    }
  };
  std::vector<char> is_held(mesh.nodes.size(), 0);
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    if (scheme::boundary_menu().at(boundary.type).acts != scheme::BoundaryKind::Acts::load)
      for_nodes(boundary.groups, [&](std::int32_t a) { is_held[static_cast<size_t>(a)] = 1; });
  }
  for (const cases::ProbeCase& probe : setup.probes) {
    if (probe.kind != "reaction") continue;
    bool is_idle = true;
    for_nodes(probe.groups,
              [&](std::int32_t a) { is_idle &= is_held[static_cast<size_t>(a)] == 0; });
    if (!is_idle) continue;
    notices.push_back(
        fmt::format("probe '{}': no support or wall holds a node of {}, so that its reaction is "
                    "zero throughout",
                    probe.name, fmt::join(probe.groups, ", ")));
  }
}

/// What "auto" comes to where the mesh says so, which the solver does not know.
std::string reconstruction_for(const cases::Case& setup, const scheme::Operators& operators) {
  return operators.loses_sign && takes_symmetric_jumps(setup.scheme) ? "symmetric" : "";
}

cases::Case resolved(cases::Case setup, const std::string& reconstruction) {
  if (!reconstruction.empty()) setup.scheme.reconstruction = reconstruction;
  return setup;
}

}  // namespace

CaseGraph graph_of(const cases::Case& setup,
                   const std::string& method,
                   int level,
                   const PartMade& made) {
  CaseGraph scene;
  require_memory(setup, {method}, {level});
  scene.mesh = mesh_of(setup, level);
  unite_overlapping_groups(setup, scene.mesh.mesh);
  require_memory(setup, method, level, scene.mesh.mesh);
  require_walls_before_sides(setup, scene.mesh.mesh);
  if (made) made(ScenePart::mesh, scene);
  scheme::Operators operators = method_menu().at(method)(scene.mesh.mesh, setup);
  scene.reconstruction = reconstruction_for(setup, operators);
  scene.graph = std::move(operators.graph);
  scene.operators = std::move(operators.text);
  if (!scene.reconstruction.empty())
    scene.operators += fmt::format("; {} reconstruction", scene.reconstruction);
  scene.notices = std::move(operators.notices);
  note_mesh(setup, scene.mesh.mesh, level, scene.notices);
  note_unseen_fields(setup, scene.mesh.mesh, scene.notices);
  note_idle_reactions(setup, scene.mesh.mesh, scene.notices);
  if (made) made(ScenePart::graph, scene);
  return scene;
}

Scene::Scene(const cases::Case& setup,
             const std::string& method,
             int level,
             GraphPairs pairs,
             const PartMade& made)
    : CaseGraph(graph_of(setup, method, level, made)),
      solver(pairs == GraphPairs::released
                 ? run::make_solver_of_pairs(resolved(setup, reconstruction), graph)
                 : run::make_solver(resolved(setup, reconstruction), graph)) {
  // refuses what is too fast, while none runs
  (void)run::step_ends(setup, solver->undeformed_step(), solver->telling_places());
  if (made) made(ScenePart::solver, *this);
}

}  // namespace diptych::harness
