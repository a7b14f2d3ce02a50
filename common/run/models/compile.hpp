#pragma once
/// Compiles a material for all that a run does with it; a file of each material includes this. A
/// material gives energy(X), response(X), from(moduli, zeta_ratio), branch_xi(), branch_zeta(),
/// has_H and has_W_FJ (common/physics/materials).

#include "common/exact/manufactured/manufactured_solution.hpp"
#include "common/run/model_menu.hpp"
#include "common/scheme/sweeps/compiled_material.hpp"

namespace diptych::run {

template <class Material>
std::shared_ptr<const scheme::MaterialModel> compiled_material(const cases::MaterialCase& m) {
  const auto material = Material::from({m.shear_modulus, m.lame}, m.zeta_ratio);
  return std::make_shared<scheme::CompiledMaterial<Material>>(scheme::Model<Material>{
      material, m.density, branches_of(m, material.branch_xi(), material.branch_zeta())});
}

template <class Material>
std::shared_ptr<exact::KnownState> known_state(const scheme::MaterialModel& model,
                                               const cases::Case& setup,
                                               const scheme::PairGraph& graph) {
  const auto& typed = static_cast<const scheme::CompiledMaterial<Material>&>(model).model();
  const auto known = graph.dimension == 2 ? exact::manufactured_solution<2, Material>
                                          : exact::manufactured_solution<3, Material>;
  return known(setup.motion, typed, graph.X, setup.initial.relaxed, setup.time.end);
}

}  // namespace diptych::run

#define DIPTYCH_COMPILE_MATERIAL(name, Material)                 \
  template class diptych::scheme::CompiledMaterial<Material>;    \
  namespace diptych::run {                                       \
  ModelMaker make_##name() {                                     \
    return {compiled_material<Material>, known_state<Material>}; \
  }                                                              \
  }
