#include "common/run/model_menu.hpp"

namespace diptych::run {

#define DIPTYCH_MATERIAL(name, function) ModelMaker make_##function();
#include "common/run/models/materials.def"
#undef DIPTYCH_MATERIAL

const base::Registry<ModelMaker>& model_menu() {
  static const auto menu = [] {
    base::Registry<ModelMaker> all("material.model");
#define DIPTYCH_MATERIAL(name, function) all.add(name, make_##function());
#include "common/run/models/materials.def"
#undef DIPTYCH_MATERIAL
    return all;
  }();
  return menu;
}

std::vector<physics::MaxwellBranch> branches_of(const cases::MaterialCase& material,
                                                double xi,
                                                double zeta) {
  std::vector<physics::MaxwellBranch> branches;
  for (const cases::BranchCase& b : material.branches) {
    branches.push_back({b.beta_C * xi, b.tau_C, b.beta_G * zeta, b.tau_G});
  }
  return branches;
}

}  // namespace diptych::run
