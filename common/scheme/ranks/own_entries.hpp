#pragma once
/// What rank 0 has for every node, at the ranks that own them. Test: tests/ranks

#include "common/parallel/part.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych::scheme {

class OwnEntries {
 public:
  /// All ranks call this together.
  /// @param of_nodes  [n_nodes] on rank 0, which must outlive this
  OwnEntries(const parallel::Part& part,
             std::span<const std::int32_t> of_nodes,
             std::int64_t n_nodes);

  /// Those of the nodes of an own chunk.
  std::span<const std::int32_t> of_chunk(std::int64_t chunk) const;

 private:
  const parallel::Part& part_;
  std::span<const std::int32_t> all_;
  std::vector<std::int32_t> own_;  ///< of ranks but 0: chunk by chunk
};

}  // namespace diptych::scheme
