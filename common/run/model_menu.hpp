#pragma once
/// The menu of compiled materials. Branches, unknowns and scheme options are chosen inside. Adding
/// one: its header in common/physics/materials, its file in models/, a line in
/// models/materials.def.

#include "common/base/registry.hpp"
#include "common/cases/case.hpp"
#include "common/exact/manufactured/manufactured_solution.hpp"
#include "common/scheme/body/material_model.hpp"

#include <memory>

namespace diptych::run {

/// The Maxwell branches of a case for a material with these moduli.
std::vector<physics::MaxwellBranch> branches_of(const cases::MaterialCase& material,
                                                double xi,
                                                double zeta);

/// What is compiled of a material.
struct ModelMaker {
  std::shared_ptr<const scheme::MaterialModel> (*model)(const cases::MaterialCase& material);
  /// The exact state of a manufactured motion; the model is this material's.
  std::shared_ptr<exact::KnownState> (*known)(const scheme::MaterialModel& model,
                                              const cases::Case& setup,
                                              const scheme::PairGraph& graph);
};

/// mooney-rivlin, neo-hookean, neo-hookean-isochoric, neo-hookean-isochoric-j2
const base::Registry<ModelMaker>& model_menu();

}  // namespace diptych::run
