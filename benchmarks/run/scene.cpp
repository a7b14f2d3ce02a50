#include "benchmarks/run/scene.hpp"

#include "benchmarks/run/memory_estimate.hpp"
#include "meshes/cavities.hpp"

#include <fmt/format.h>
#include <utility>

namespace diptych::harness {

namespace {

/// Of a file: where a cell is missing the mesh is that of a hollow body.
void note_cavities(const meshes::Mesh& mesh, std::vector<std::string>& notices) {
  for (const meshes::Cavity& cavity : meshes::cavities_of(mesh)) {
    if (cavity.is_grouped) continue;
    notices.push_back(fmt::format(
        "mesh: a cavity of {:.3g} {} inside the body, {} faces around ({:.6g}, {:.6g}, {:.6g}) m: "
        "cells are missing there, unless it is meant (a boundary group on it says so)",
        cavity.volume, mesh.dimension == 2 ? "m^2" : "m^3", cavity.n_faces, cavity.centre[0],
        cavity.centre[1], cavity.centre[2]));
  }
}

}  // namespace

CaseGraph graph_of(const cases::Case& setup,
                   const std::string& method,
                   int level,
                   const PartMade& made) {
  CaseGraph scene;
  require_memory(setup, {method}, {level});
  scene.mesh = mesh_of(setup, level);
  require_memory(setup, method, level, scene.mesh.mesh);
  if (made) made(ScenePart::mesh, scene);
  scheme::Operators operators = method_menu().at(method)(scene.mesh.mesh, setup);
  scene.graph = std::move(operators.graph);
  scene.operators = std::move(operators.text);
  scene.notices = std::move(operators.notices);
  if (!setup.mesh.file.empty()) note_cavities(scene.mesh.mesh, scene.notices);
  if (made) made(ScenePart::graph, scene);
  return scene;
}

Scene::Scene(const cases::Case& setup,
             const std::string& method,
             int level,
             GraphPairs pairs,
             const PartMade& made)
    : CaseGraph(graph_of(setup, method, level, made)),
      solver(pairs == GraphPairs::released ? run::make_solver_of_pairs(setup, graph)
                                           : run::make_solver(setup, graph)) {
  if (made) made(ScenePart::solver, *this);
}

}  // namespace diptych::harness
