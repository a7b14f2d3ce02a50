#include "benchmarks/run/scene.hpp"

#include "benchmarks/run/memory_estimate.hpp"

namespace diptych::harness {

CaseGraph graph_of(const cases::Case& setup,
                   const std::string& method,
                   int level,
                   const PartMade& made) {
  CaseGraph scene;
  require_memory(setup, {method}, {level});
  scene.mesh = mesh_of(setup, level);
  require_memory(setup, method, level, scene.mesh.mesh);
  if (made) made(ScenePart::mesh);
  scene.graph = method_menu().at(method)(scene.mesh.mesh, setup);
  scene.description = graph_description(method, scene.mesh.mesh, setup);
  if (made) made(ScenePart::graph);
  return scene;
}

Scene::Scene(const cases::Case& setup, const std::string& method, int level, const PartMade& made)
    : CaseGraph(graph_of(setup, method, level, made)), solver(run::make_solver(setup, graph)) {
  if (made) made(ScenePart::solver);
}

}  // namespace diptych::harness
