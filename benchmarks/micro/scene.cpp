#include "benchmarks/micro/scene.hpp"

#include "benchmarks/run/scene.hpp"
#include "common/cases/reader.hpp"
#include "common/run/initial_state.hpp"
#include "common/run/model_menu.hpp"

#include <filesystem>
#include <map>

namespace diptych::micro {

namespace {

const char* const cube = R"toml(
[mesh]
lower = [0, 0, 0]
upper = [1, 1, 1]
cells = [28, 28, 28]
[material]
model = "mooney-rivlin"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
zeta_ratio = 0.5
[initial]
displacement = ["0.05*sin(3*x + y)", "0.05*cos(2*y - z)", "0.05*sin(x + 2*z)"]
velocity = ["sin(3*y)", "cos(2*z)", "sin(3*x)"]
[time]
end = 1
)toml";

}  // namespace

cases::Case case_of(const SceneChoice& choice, const std::string& integrator) {
  std::vector<std::string> overrides{"time.integrator=" + integrator};
  overrides.push_back(choice.graph.starts_with("fvm-tet") ? "mesh.element=tetrahedron"
                                                          : "mesh.element=hexahedron");
  if (choice.graph.find(" moved") != std::string::npos)
    overrides.push_back("mesh.perturbation=0.2");
  for (const char* const precision : {"mixed", "single"}) {
    if (choice.graph.ends_with(precision))
      overrides.push_back(std::string("scheme.precision=") + precision);
  }
  if (choice.face_correction) overrides.push_back("scheme.face_correction=1/6");
  cases::Case setup = cases::case_from_text(cube, "micro", overrides);
  for (int k = 0; k < choice.n_branches; ++k)
    setup.material.branches.push_back({0.5, 1e-3 * (k + 1), 0.5, 2e-3 * (k + 1)});
  return setup;
}

const scheme::PairGraph& graph_of(const std::string& graph) {
  static std::map<std::string, scheme::PairGraph> graphs;
  const auto found = graphs.find(graph);
  if (found != graphs.end()) return found->second;
  const std::string method = graph.starts_with("sph") ? "sph" : "fvm";
  return graphs.emplace(graph, harness::graph_of(case_of({graph}), method, 0).graph).first->second;
}

namespace {

scheme::Body<3> body_of(const SceneChoice& choice, const scheme::MaterialModel& material) {
  scheme::BodyOptions options;
  options.rho_R = material.rho_R();
  options.n_branches = choice.n_branches;
  options.has_G = true;
  options.keeps_L_0 = choice.n_branches > 0;
  options.face_correction = choice.face_correction;
  const scheme::PairGraph& graph = graph_of(choice.graph);
  return choice.arrangement ? scheme::Body<3>(graph, options, *choice.arrangement)
                            : scheme::Body<3>(graph, options);
}

}  // namespace

Scene::Scene(const SceneChoice& choice)
    : material(run::model_menu().at("mooney-rivlin").model(case_of(choice).material)),
      body(body_of(choice, *material)) {
  const cases::Case setup = case_of(choice);
  run::set_initial_state(setup.initial, setup.scheme.face_correction, body);
  for (std::int64_t b = 0; b < body.n_blocks; ++b)
    algebra::put_tensor<3>(body.F_0, b, 0, algebra::get_tensor<3>(body.F, b, 0));
}

}  // namespace diptych::micro
