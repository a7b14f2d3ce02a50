#pragma once
/// In which chunk of parallel::for_chunks the nodes of a body are.

#include "common/algebra/lanes.hpp"
#include "common/parallel/for_chunks.hpp"

#include <cstdint>

namespace diptych::scheme {

constexpr std::int64_t chunk_nodes = parallel::chunk_size * algebra::n_lanes;

inline std::int64_t chunk_of_node(std::int64_t node) {
  return node / chunk_nodes;
}

}  // namespace diptych::scheme
