#include "common/parallel/halo.hpp"

namespace diptych::parallel {

void Halo::ask_for(const std::vector<std::vector<NodeRange>>& wanted) {
  const auto n = static_cast<size_t>(ranks_->size());
  const auto me = static_cast<size_t>(ranks_->rank());
  // how many ranges rank r wants of rank q stands in row r, column q
  std::vector<std::int64_t> counts(n * n);
  for (size_t q = 0; q < n; ++q)
    counts[me * n + q] = std::ssize(wanted[q]);
  const std::vector<std::int64_t> bytes(n, static_cast<std::int64_t>(n * sizeof(std::int64_t)));
  ranks_->all_gather(bytes_of(counts.data()), bytes);
  std::vector<std::vector<NodeRange>> asked(n), out = wanted;
  std::vector<Parcel> sends, receives;
  constexpr auto size = static_cast<std::int64_t>(sizeof(NodeRange));
  for (size_t r = 0; r < n; ++r) {
    const auto rank = static_cast<int>(r);
    asked[r].resize(static_cast<size_t>(counts[r * n + me]));
    if (!out[r].empty())
      sends.push_back({rank, bytes_of(out[r].data()), size * std::ssize(out[r])});
    if (!asked[r].empty())
      receives.push_back({rank, bytes_of(asked[r].data()), size * std::ssize(asked[r])});
  }
  ranks_->begin_exchange(sends, receives);
  ranks_->finish_exchange();
  for (size_t r = 0; r < n; ++r) {
    if (!wanted[r].empty() || !asked[r].empty())
      neighbours_.push_back({static_cast<int>(r), asked[r], wanted[r], {}, {}});
  }
}

std::vector<NodeRange> Halo::received() const {
  std::vector<NodeRange> all;
  for (const Neighbour& other : neighbours_)
    all.insert(all.end(), other.receives.begin(), other.receives.end());
  return all;
}

std::vector<NodeRange> Halo::sent() const {
  std::vector<NodeRange> all;
  for (const Neighbour& other : neighbours_)
    all.insert(all.end(), other.sends.begin(), other.sends.end());
  return all;
}

}  // namespace diptych::parallel
