#include "common/scheme/sweeps/compiled/strain_rates.hpp"

namespace diptych::scheme {

template StrainRateFunction<3> strain_rate_function<3>();
template void evaluate_strain_rates(const StrainRateSweep<3>&, Share);
template void velocity_gradients(Body<3>&, double);

}  // namespace diptych::scheme
