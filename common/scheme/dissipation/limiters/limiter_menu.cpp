#include "common/scheme/dissipation/limiters/limiter_menu.hpp"

namespace diptych::scheme {

const base::Registry<PairLimiter>& limiter_menu() {
  static const auto menu = [] {
    base::Registry<PairLimiter> all("scheme.limiter");
#define DIPTYCH_LIMITER(name, id, Type) all.add(name, PairLimiter::id);
#include "common/scheme/dissipation/limiters/limiters.def"
#undef DIPTYCH_LIMITER
    return all;
  }();
  return menu;
}

}  // namespace diptych::scheme
