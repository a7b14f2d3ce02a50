#include "common/parallel/part.hpp"

#include <cstring>
#include <numeric>

namespace diptych::parallel {

Part::Part(Communicator& ranks, std::vector<int> owner_of_chunk)
    : ranks_(&ranks), rank_(ranks.rank()), owner_(std::move(owner_of_chunk)), all_(owner_.size()) {
  for (size_t chunk = 0; chunk < owner_.size(); ++chunk) {
    if (owner_[chunk] == rank_) own_.push_back(static_cast<std::int64_t>(chunk));
  }
  std::iota(all_.begin(), all_.end(), 0);
}

void Part::complete_entries(std::byte* values,
                            std::int64_t size,
                            std::span<const std::int32_t> chunk_of) const {
  if (chunk_of.empty()) return;
  std::vector<std::int64_t> bytes(static_cast<size_t>(ranks_->size()));
  for (const std::int32_t chunk : chunk_of)
    bytes[owner_[chunk]] += size;
  std::vector<std::int64_t> next(bytes.size());
  std::exclusive_scan(bytes.begin(), bytes.end(), next.begin(), std::int64_t{0});
  std::vector<std::byte> all(static_cast<size_t>(size) * chunk_of.size());
  const auto for_entries = [&](const auto& use) {
    std::vector<std::int64_t> at = next;
    for (size_t k = 0; k < chunk_of.size(); ++k) {
      const int owner = owner_[chunk_of[k]];
      use(owner, values + static_cast<std::int64_t>(k) * size, all.data() + at[owner]);
      at[owner] += size;
    }
  };
  for_entries([&](int owner, const std::byte* value, std::byte* place) {
    if (owner == rank_) std::memcpy(place, value, static_cast<size_t>(size));
  });
  ranks_->all_gather(all.data(), bytes);
  for_entries([&](int owner, std::byte* value, const std::byte* place) {
    if (owner != rank_) std::memcpy(value, place, static_cast<size_t>(size));
  });
}

ChunksOfList::ChunksOfList(const std::vector<std::int64_t>& chunk_of_entry)
    : entry(chunk_of_entry.size()) {
  std::iota(entry.begin(), entry.end(), std::int64_t{0});
  std::stable_sort(entry.begin(), entry.end(), [&](std::int64_t a, std::int64_t b) {
    return chunk_of_entry[a] < chunk_of_entry[b];
  });
  for (size_t k = 0; k < entry.size(); ++k) {
    const auto of = static_cast<std::int32_t>(chunk_of_entry[entry[k]]);
    if (!chunk.empty() && chunk.back() == of) continue;
    chunk.push_back(of);
    first.push_back(static_cast<std::int64_t>(k));
  }
  first.push_back(static_cast<std::int64_t>(entry.size()));
}

}  // namespace diptych::parallel
