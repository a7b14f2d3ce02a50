#pragma once
/// How often a run was changed by what is no part of (18): counted for its summary, so that nothing
/// acts unseen.

#include <cstdint>

namespace diptych::scheme {

struct Interventions {
  std::int64_t projections = 0;         ///< of the velocities (notes 3.7) that changed them
  std::int64_t resynchronisations = 0;  ///< H and J of all nodes made anew from F (notes 3.5)
  std::int64_t limited_pairs = 0;  ///< whose jump the limiter changed by 1 %, over all evaluations
};

}  // namespace diptych::scheme
