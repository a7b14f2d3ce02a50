#pragma once
/// Small scenes for tests of the scheme: a case from text with its graph and solver, made as the
/// program makes them; graphs of meshes of their own.

#include "benchmarks/run/scene.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "meshes/generators.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace diptych::tests {

/// Before the scene that is made of it.
struct SceneCase {
  cases::Case setup;
};

struct Scene : SceneCase, harness::Scene {
  Scene(const std::string& method, cases::Case of, int level = 0)
      : SceneCase{std::move(of)}, harness::Scene(setup, method, level) {}
};

/// A case whose operators are those of second order on any mesh: the corrected gradient, edges.
inline cases::Case second_order() {
  cases::Case setup;
  setup.sph.gradient = "corrected";
  setup.fvm.stencil = "edge";
  return setup;
}

/// The graph that a method makes of a mesh by the keys of a case.
inline scheme::PairGraph graph_of(const std::string& method,
                                  const meshes::Mesh& mesh,
                                  const cases::Case& setup = second_order()) {
  return harness::method_menu().at(method)(mesh, setup).graph;
}

inline Scene scene_of(const std::string& method,
                      const std::string& text,
                      const std::vector<std::string>& overrides = {}) {
  return {method, cases::case_from_text(text, "scene", overrides)};
}

/// What such a scene is refused with; empty where it can be made.
inline std::string refusal_of(const std::string& method,
                              const std::string& text,
                              const std::vector<std::string>& overrides = {}) {
  try {
    scene_of(method, text, overrides);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

inline void run_to(run::Solver& solver, double end) {
  while (solver.time() < end)
    solver.step(end);
}

/// Numbers 0 .. n-1: the user's order of a box.
inline std::vector<std::int32_t> natural_order(const scheme::PairGraph& graph) {
  std::vector<std::int32_t> order(graph.X.size());
  for (size_t a = 0; a < order.size(); ++a)
    order[a] = static_cast<std::int32_t>(a);
  return order;
}

/// The solid of most scenes, with one branch of each kind.
inline std::string viscoelastic(const std::string& poissons_ratio) {
  return R"([material]
model = "mooney-rivlin"
density = 1100
youngs_modulus = 17e6
poissons_ratio = )" +
         poissons_ratio + R"(
zeta_ratio = 0.5
[[material.branch]]
beta_C = 0.5
tau_C = 2e-3
beta_G = 0.5
tau_G = 1e-3
)";
}

/// A free viscoelastic cube that spins and stretches at large strain.
inline const std::string spinning_cube = R"(
[mesh]
element = "hexahedron"
lower = [-0.5, -0.5, -0.5]
upper = [0.5, 0.5, 0.5]
cells = [5, 5, 5]
)" + viscoelastic("0.45") + R"([initial]
velocity = ["-105*y + 20*x", "105*x - 10*y", "-10*z"]
[time]
end = 4e-3
integrator = "ssp-rk3"
)";

/// The same without branches.
inline std::string elastic(std::string text) {
  const size_t begin = text.find("[[material.branch]]"), end = text.find("[initial]");
  return text.erase(begin, end - begin);
}

}  // namespace diptych::tests
