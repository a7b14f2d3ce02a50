#pragma once
/// The options of the scheme under their names in case files. The limiters have a menu of their
/// own.

#include "common/base/registry.hpp"
#include "common/scheme/body/body.hpp"
#include "common/scheme/dissipation/dissipation.hpp"
#include "common/scheme/graph/pair_graph.hpp"
#include "common/scheme/time_step.hpp"

namespace diptych::scheme {

const base::Registry<Unknowns>& unknowns_menu();
const base::Registry<ReconstructionChoice>& reconstruction_menu();
const base::Registry<Impedance>& impedance_menu();
const base::Registry<Precision>& precision_menu();
const base::Registry<Volumes>& volumes_menu();
/// The name of an entry of it.
std::string name_of(Volumes volumes);
const base::Registry<Speeds>& speeds_menu();

}  // namespace diptych::scheme
