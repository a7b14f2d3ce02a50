#include "common/scheme/momentum.hpp"

namespace diptych::scheme {

template <>
MomentumFunction<3> momentum_function<3>(const DissipationKind& kind, bool has_H) {
  return momentum_function_of<3>(kind, has_H);
}

}  // namespace diptych::scheme
