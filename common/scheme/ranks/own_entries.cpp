#include "common/scheme/ranks/own_entries.hpp"

#include "common/scheme/body/node_chunks.hpp"

#include <algorithm>

namespace diptych::scheme {

namespace {

std::span<const std::int32_t> entries_of(std::span<const std::int32_t> all, std::int64_t chunk) {
  const std::int64_t begin = chunk * chunk_nodes,
                     n = std::min(chunk_nodes, std::ssize(all) - begin);
  return all.subspan(static_cast<size_t>(begin), static_cast<size_t>(n));
}

parallel::Parcel parcel_of(int rank, std::vector<std::int32_t>& entries) {
  return {rank, parallel::bytes_of(entries.data()),
          std::ssize(entries) * static_cast<std::int64_t>(sizeof(std::int32_t))};
}

}  // namespace

OwnEntries::OwnEntries(const parallel::Part& part,
                       std::span<const std::int32_t> of_nodes,
                       std::int64_t n_nodes)
    : part_(part), all_(of_nodes) {
  if (part.is_whole()) return;
  parallel::Communicator& ranks = part.ranks();
  std::vector<std::vector<std::int32_t>> of_rank(static_cast<size_t>(ranks.size()));
  if (ranks.rank() == 0) {
    const std::int64_t n_chunks = (n_nodes + chunk_nodes - 1) / chunk_nodes;
    for (std::int64_t chunk = 0; chunk < n_chunks; ++chunk) {
      const auto entries = entries_of(all_, chunk);
      std::vector<std::int32_t>& theirs = of_rank[static_cast<size_t>(part.owner(chunk))];
      if (part.owner(chunk) != 0) theirs.insert(theirs.end(), entries.begin(), entries.end());
    }
    std::vector<parallel::Parcel> parcels;
    for (int rank = 1; rank < ranks.size(); ++rank) {
      if (std::vector<std::int32_t>& theirs = of_rank[static_cast<size_t>(rank)]; !theirs.empty())
        parcels.push_back(parcel_of(rank, theirs));
    }
    ranks.begin_exchange(parcels, {});
    ranks.finish_exchange();
    return;
  }
  std::int64_t n_own = 0;
  for (const std::int64_t chunk : part.own_chunks())
    n_own += std::min(chunk_nodes, n_nodes - chunk * chunk_nodes);
  own_.resize(static_cast<size_t>(n_own));
  std::vector<parallel::Parcel> parcels;
  if (n_own > 0) parcels.push_back(parcel_of(0, own_));
  ranks.begin_exchange({}, parcels);
  ranks.finish_exchange();
}

std::span<const std::int32_t> OwnEntries::of_chunk(std::int64_t chunk) const {
  if (part_.is_whole() || part_.rank() == 0) return entries_of(all_, chunk);
  const std::vector<std::int64_t>& chunks = part_.own_chunks();
  return entries_of(own_, std::lower_bound(chunks.begin(), chunks.end(), chunk) - chunks.begin());
}

}  // namespace diptych::scheme
