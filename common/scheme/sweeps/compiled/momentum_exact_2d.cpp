#include "common/scheme/sweeps/compiled/momentum.hpp"

namespace diptych::scheme {

template MomentumFunction<2> momentum_sweep_of<2, Impedance::exact, true>(const DissipationKind&);
template MomentumFunction<2> momentum_sweep_of<2, Impedance::exact, false>(const DissipationKind&);

}  // namespace diptych::scheme
