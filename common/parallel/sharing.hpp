#pragma once
/// What rank 0 has, for all ranks: values, texts and arrays, whatever their length. All ranks call
/// the same in the same order. Test: tests/ranks

#include "common/parallel/communicator.hpp"

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

}  // namespace diptych::parallel
