#include "common/scheme/sweeps/compiled/jump_adjoint.hpp"

namespace diptych::scheme {

template MomentumFunction<3> moments_sweep_of<3, Impedance::isotropic, true>();
template MomentumFunction<3> moments_sweep_of<3, Impedance::exact, true>();
template MomentumFunction<3> moments_sweep_of<3, Impedance::exact, false>();

}  // namespace diptych::scheme
