#pragma once
/// The limiters of the reconstruction by name. Adding one: a header beside this one, its two lines
/// in limiters.def.

#include "common/base/registry.hpp"
#include "common/scheme/dissipation/dissipation.hpp"

namespace diptych::scheme {

/// none, barth-jespersen, venkatakrishnan, sign-preserving
const base::Registry<PairLimiter>& limiter_menu();

}  // namespace diptych::scheme
