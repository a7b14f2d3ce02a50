#include "common/scheme/momentum.hpp"

namespace diptych::scheme {

extern template MomentumFunction<2> momentum_sweep_of<2, Impedance::isotropic, true>(
    const DissipationKind&);
extern template MomentumFunction<3> momentum_sweep_of<3, Impedance::isotropic, true>(
    const DissipationKind&);
extern template MomentumFunction<2> momentum_sweep_of<2, Impedance::exact, true>(
    const DissipationKind&);
extern template MomentumFunction<3> momentum_sweep_of<3, Impedance::exact, true>(
    const DissipationKind&);
extern template MomentumFunction<2> momentum_sweep_of<2, Impedance::exact, false>(
    const DissipationKind&);
extern template MomentumFunction<3> momentum_sweep_of<3, Impedance::exact, false>(
    const DissipationKind&);

template <int Dim>
MomentumFunction<Dim> momentum_function(const DissipationKind& kind, bool has_H) {
  if (kind.impedance == Impedance::isotropic) {
    return momentum_sweep_of<Dim, Impedance::isotropic, true>(kind);
  }
  return has_H ? momentum_sweep_of<Dim, Impedance::exact, true>(kind)
               : momentum_sweep_of<Dim, Impedance::exact, false>(kind);
}

template MomentumFunction<2> momentum_function<2>(const DissipationKind& kind, bool has_H);
template MomentumFunction<3> momentum_function<3>(const DissipationKind& kind, bool has_H);

}  // namespace diptych::scheme
