#include "common/scheme/dissipation/limiters/limiter_menu.hpp"

namespace diptych::scheme {

const base::Registry<PairLimiter>& limiter_menu() {
  static const auto menu = base::Registry<PairLimiter>("scheme.limiter")
                               .add("none", PairLimiter::none)
                               .add("barth-jespersen", PairLimiter::barth_jespersen)
                               .add("venkatakrishnan", PairLimiter::venkatakrishnan)
                               .add("sign-preserving", PairLimiter::sign_preserving);
  return menu;
}

}  // namespace diptych::scheme
