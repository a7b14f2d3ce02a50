#include "common/scheme/momentum.hpp"

namespace diptych::scheme {

template <>
MomentumFunction<2> momentum_function<2>(const DissipationKind& kind, bool has_H) {
  return momentum_function_of<2>(kind, has_H);
}

}  // namespace diptych::scheme
