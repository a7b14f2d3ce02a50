#include "common/scheme/sweeps/compiled/momentum.hpp"

namespace diptych::scheme {

template MomentumFunction<3> momentum_sweep_of<3, Impedance::exact, true>(const DissipationKind&);
template MomentumFunction<3> momentum_sweep_of<3, Impedance::exact, false>(const DissipationKind&);

}  // namespace diptych::scheme
