#pragma once
/// The part of a body that a rank works on: chunks of blocks (for_chunks.hpp), whose numbers do not
/// depend on the ranks. Sums over a body (reduction.hpp) have the same bits for every number of
/// ranks, and whatever is decided by them is decided alike everywhere.
/// Test: tests/common/parallel/partition_test.cpp, tests/ranks

#include "common/parallel/communicator.hpp"
#include "common/parallel/for_chunks.hpp"

#include <span>
#include <vector>

namespace diptych::parallel {

class Part {
 public:
  /// Everything: that of one rank.
  Part() = default;
  /// @param owner_of_chunk  the same on all ranks
  Part(Communicator& ranks, std::vector<int> owner_of_chunk);

  bool is_whole() const { return ranks_ == nullptr; }
  /// @pre !is_whole()
  Communicator& ranks() const { return *ranks_; }
  /// Ascending; empty where it is everything.
  const std::vector<std::int64_t>& own_chunks() const { return own_; }
  int owner(std::int64_t chunk) const { return is_whole() ? 0 : owner_[chunk]; }
  bool owns(std::int64_t chunk) const { return is_whole() || owner_[chunk] == rank_; }
  int rank() const { return rank_; }

  /// Each entry as the owner of its chunk has it.
  /// @param values  [chunk_of] of a type without pointers
  template <class T>
  void complete(std::vector<T>& values, std::span<const std::int32_t> chunk_of) const {
    if (is_whole()) return;
    complete_entries(bytes_of(values.data()), sizeof(T), chunk_of);
  }
  template <class T>
  void complete(std::vector<T>& values) const {
    if (is_whole()) return;
    complete_entries(bytes_of(values.data()), sizeof(T), all_);
  }

 private:
  void complete_entries(std::byte* values,
                        std::int64_t size,
                        std::span<const std::int32_t> chunk_of) const;

  Communicator* ranks_ = nullptr;
  int rank_ = 0;
  std::vector<int> owner_;         // [n_chunks]
  std::vector<std::int64_t> own_;  // chunks
  std::vector<std::int32_t> all_;  // 0, 1, .. n_chunks - 1
};

/// Calls work(begin, end, chunk) for these chunks of [0, n).
template <class Work>
void for_chunks(std::span<const std::int64_t> chunks, std::int64_t n, const Work& work) {
  const std::int64_t n_chunks = std::ssize(chunks);
#pragma omp parallel for schedule(static) if (n_chunks > 1)
  for (std::int64_t i = 0; i < n_chunks; ++i) {
    const std::int64_t chunk = chunks[i], begin = chunk * chunk_size;
    work(begin, std::min(n, begin + chunk_size), chunk);
  }
}

/// Calls work(begin, end, chunk) for the chunks of [0, n) that are of this part.
template <class Work>
void for_chunks(const Part& part, std::int64_t n, const Work& work) {
  if (part.is_whole()) {
    for_chunks(n, work);
  } else {
    for_chunks(part.own_chunks(), n, work);
  }
}

/// Entries of a list of nodes, by the chunks that the nodes are in.
struct ChunksOfList {
  std::vector<std::int32_t> chunk;  ///< [n_groups] ascending
  std::vector<std::int64_t> first;  ///< [n_groups + 1] into entry
  std::vector<std::int64_t> entry;  ///< places in the list, as they stand there in each group

  ChunksOfList() = default;
  /// @param chunk_of_entry  of the node of each entry
  explicit ChunksOfList(const std::vector<std::int64_t>& chunk_of_entry);
  std::int64_t n_groups() const { return static_cast<std::int64_t>(chunk.size()); }
};

}  // namespace diptych::parallel
