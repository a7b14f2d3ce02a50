#include "common/scheme/sweeps/compiled/jump_adjoint.hpp"

namespace diptych::scheme {

template MomentumFunction<2> moments_sweep_of<2, Impedance::isotropic, true>();
template MomentumFunction<2> moments_sweep_of<2, Impedance::exact, true>();
template MomentumFunction<2> moments_sweep_of<2, Impedance::exact, false>();

}  // namespace diptych::scheme
