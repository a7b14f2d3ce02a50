#pragma once
/// What rank 0 has, for all ranks: values, texts and arrays, whatever their length. All ranks call
/// the same in the same order. Test: tests/ranks

#include "common/parallel/communicator.hpp"

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

namespace diptych::parallel {

template <class T>
void share(Communicator& ranks, T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  ranks.broadcast(bytes_of(&value), sizeof value);
}

inline void share(Communicator& ranks, std::string& text) {
  auto n = std::ssize(text);
  share(ranks, n);
  text.resize(static_cast<size_t>(n));
  ranks.broadcast(bytes_of(text.data()), n);
}

/// Of values without pointers; vectors and matrices of fixed size are such.
template <class T>
void share(Communicator& ranks, std::vector<T>& values) {
  auto n = std::ssize(values);
  share(ranks, n);
  values.resize(static_cast<size_t>(n));
  ranks.broadcast(bytes_of(values.data()), n * static_cast<std::int64_t>(sizeof(T)));
}

/// Calls use(first, piece) for consecutive pieces of a table that rank 0 has, so that no other rank
/// has all of it.  @param whole  null on other ranks
template <class T, class Use>
void share_pieces(Communicator& ranks, const std::vector<T>* whole, const Use& use) {
  constexpr std::int64_t together = 1 << 15;
  std::int64_t n = whole == nullptr ? 0 : std::ssize(*whole);
  share(ranks, n);
  std::vector<T> piece;
  for (std::int64_t first = 0; first < n; first += together) {
    if (whole != nullptr)
      piece.assign(whole->begin() + first, whole->begin() + std::min(n, first + together));
    share(ranks, piece);
    use(first, piece);
  }
}

}  // namespace diptych::parallel
