#include "common/scheme/sweeps/compiled/strain_rates.hpp"

namespace diptych::scheme {

template StrainRateFunction<2> strain_rate_function<2>();
template void evaluate_strain_rates(const StrainRateSweep<2>&, Share);
template void velocity_gradients(Body<2>&, double);

}  // namespace diptych::scheme
