#include "common/physics/materials/isochoric_neo_hookean.hpp"

#include "common/run/models/compile.hpp"

DIPTYCH_COMPILE_MATERIAL(isochoric_neo_hookean, diptych::physics::IsochoricNeoHookean)
