#include "common/physics/materials/plain_rubber.hpp"

#include "common/run/models/compile.hpp"

DIPTYCH_COMPILE_MATERIAL(plain_rubber, diptych::physics::PlainRubber)
