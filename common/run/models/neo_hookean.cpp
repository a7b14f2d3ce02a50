#include "common/physics/materials/mooney_rivlin.hpp"
#include "common/run/models/compile.hpp"

DIPTYCH_COMPILE_MATERIAL(neo_hookean, diptych::physics::NeoHookean)
