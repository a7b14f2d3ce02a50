#include "common/scheme/option_menus.hpp"

namespace diptych::scheme {

const base::Registry<Unknowns>& unknowns_menu() {
  static const auto menu = base::Registry<Unknowns>("scheme.unknowns")
                               .add("F", Unknowns::F)
                               .add("FJ", Unknowns::FJ)
                               .add("FHJ", Unknowns::FHJ);
  return menu;
}

const base::Registry<ReconstructionChoice>& reconstruction_menu() {
  static const auto menu = base::Registry<ReconstructionChoice>("scheme.reconstruction")
                               .add("auto", ReconstructionChoice::automatic)
                               .add("none", ReconstructionChoice::none)
                               .add("linear", ReconstructionChoice::linear)
                               .add("quartic", ReconstructionChoice::quartic)
                               .add("objective", ReconstructionChoice::objective)
                               .add("symmetric", ReconstructionChoice::symmetric);
  return menu;
}

const base::Registry<Impedance>& impedance_menu() {
  static const auto menu = base::Registry<Impedance>("scheme.impedance")
                               .add("isotropic", Impedance::isotropic)
                               .add("exact", Impedance::exact);
  return menu;
}

const base::Registry<Precision>& precision_menu() {
  static const auto menu = base::Registry<Precision>("scheme.precision")
                               .add("double", Precision::full)
                               .add("mixed", Precision::mixed)
                               .add("single", Precision::single);
  return menu;
}

const base::Registry<Volumes>& volumes_menu() {
  static const auto menu = base::Registry<Volumes>("scheme.volumes")
                               .add("auto", Volumes::automatic)
                               .add("cells", Volumes::cells)
                               .add("lines", Volumes::lines)
                               .add("nodes", Volumes::nodes);
  return menu;
}

std::string name_of(Volumes volumes) {
  for (const std::string& name : volumes_menu().names()) {
    if (volumes_menu().at(name) == volumes) return name;
  }
  __builtin_unreachable();
}

const base::Registry<Speeds>& speeds_menu() {
  static const auto menu = base::Registry<Speeds>("time.speeds")
                               .add("exact", Speeds::exact)
                               .add("bound", Speeds::bound)
                               .add("linearised", Speeds::linearised);
  return menu;
}

}  // namespace diptych::scheme
