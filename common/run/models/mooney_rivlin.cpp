#include "common/physics/materials/mooney_rivlin.hpp"

#include "common/run/models/compile.hpp"

DIPTYCH_COMPILE_MATERIAL(mooney_rivlin, diptych::physics::MooneyRivlin)
