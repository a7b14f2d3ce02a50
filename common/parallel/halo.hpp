#pragma once
/// Which nodes a rank sends to which others and receives from them. What a field is made of in
/// memory is told by for_pieces(begin, end, use): use(bytes, n) of every piece of nodes
/// [begin, end), in an order of its own. Nodes keep their numbers in all ranks.
/// Test: tests/ranks/ranks_test.cpp

#include "common/parallel/part.hpp"

#include <cstring>
#include <vector>

namespace diptych::parallel {

struct NodeRange {
  std::int64_t begin = 0, end = 0;
};

/// Maximal ranges of the numbers that `is_in(number)` of [0, n).
template <class IsIn>
std::vector<NodeRange> ranges_of(std::int64_t n, const IsIn& is_in) {
  std::vector<NodeRange> ranges;
  for (std::int64_t a = 0; a < n; ++a) {
    if (!is_in(a)) continue;
    if (ranges.empty() || ranges.back().end != a) ranges.push_back({a, a});
    ranges.back().end = a + 1;
  }
  return ranges;
}

class Halo {
 public:
  Halo() = default;
  /// @param needed  [n_nodes] 1 where this rank reads a node; its own ones are left out
  /// @param owner   of a node
  template <class Owner>
  Halo(Communicator& ranks, const std::vector<char>& needed, const Owner& owner) : ranks_(&ranks) {
    std::vector<std::vector<NodeRange>> wanted(static_cast<size_t>(ranks.size()));
    for (int r = 0; r < ranks.size(); ++r) {
      if (r == ranks.rank()) continue;
      wanted[r] = ranges_of(static_cast<std::int64_t>(needed.size()),
                            [&](std::int64_t a) { return needed[a] != 0 && owner(a) == r; });
    }
    ask_for(wanted);
  }

  /// Begins to exchange what for_pieces tells of the nodes; what comes is put in its place by
  /// finish(for_pieces) with the same argument.
  template <class ForPieces>
  void begin(const ForPieces& for_pieces) {
    if (ranks_ == nullptr) return;
    parcels_[0].clear();
    parcels_[1].clear();
    for (Neighbour& other : neighbours_) {
      std::int64_t n = 0;
      for_each_piece(other.sends, for_pieces, [&](const std::byte*, size_t size) { n += size; });
      other.out.resize(static_cast<size_t>(n));
      std::byte* to = other.out.data();
      for_each_piece(other.sends, for_pieces, [&](const std::byte* piece, size_t size) {
        std::memcpy(to, piece, size);
        to += size;
      });
      n = 0;
      for_each_piece(other.receives, for_pieces, [&](const std::byte*, size_t size) { n += size; });
      other.in.resize(static_cast<size_t>(n));
      if (!other.out.empty())
        parcels_[0].push_back({other.rank, other.out.data(), std::ssize(other.out)});
      if (!other.in.empty())
        parcels_[1].push_back({other.rank, other.in.data(), std::ssize(other.in)});
    }
    ranks_->begin_exchange(parcels_[0], parcels_[1]);
  }
  template <class ForPieces>
  void finish(const ForPieces& for_pieces) {
    if (ranks_ == nullptr) return;
    ranks_->finish_exchange();
    for (const Neighbour& other : neighbours_) {
      const std::byte* from = other.in.data();
      for_each_piece(other.receives, for_pieces, [&](std::byte* piece, size_t size) {
        std::memcpy(piece, from, size);
        from += size;
      });
    }
  }
  template <class ForPieces>
  void exchange(const ForPieces& for_pieces) {
    begin(for_pieces);
    finish(for_pieces);
  }

  /// Nodes of others that come here, and own ones that go out, those that go to two ranks twice.
  std::vector<NodeRange> received() const;
  std::vector<NodeRange> sent() const;

 private:
  struct Neighbour {
    int rank = 0;
    std::vector<NodeRange> sends, receives;
    std::vector<std::byte> out, in;
  };
  template <class ForPieces, class Use>
  static void for_each_piece(const std::vector<NodeRange>& ranges,
                             const ForPieces& for_pieces,
                             const Use& use) {
    for (const NodeRange& range : ranges)
      for_pieces(range.begin, range.end, use);
  }
  void ask_for(const std::vector<std::vector<NodeRange>>& wanted);

  Communicator* ranks_ = nullptr;
  std::vector<Neighbour> neighbours_;
  std::vector<Parcel> parcels_[2];
};

}  // namespace diptych::parallel
