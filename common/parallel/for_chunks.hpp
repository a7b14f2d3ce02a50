#pragma once
/// Parallel loops of fixed shape (OpenMP): a range is cut into chunks that do not depend on the
/// number of threads, each chunk is worked by one thread, results of chunks are combined in order.
/// Hence every sum has the same bits for every thread count.

#include <algorithm>
#include <cstdint>
#include <vector>

namespace diptych::parallel {

/// Number of threads loops use from now on (0: as many as there are processors).
void set_threads(int n);
int n_threads();

/// Blocks of eight nodes per chunk.
inline constexpr std::int64_t chunk_size = 32;

inline std::int64_t n_chunks_of(std::int64_t n) {
  return (n + chunk_size - 1) / chunk_size;
}

/// Calls work(begin, end, chunk) for all chunks of [0, n).
template <class Work>
void for_chunks(std::int64_t n, const Work& work) {
  const std::int64_t n_chunks = n_chunks_of(n);
#pragma omp parallel for schedule(static) if (n_chunks > 1)
  for (std::int64_t chunk = 0; chunk < n_chunks; ++chunk) {
    const std::int64_t begin = chunk * chunk_size;
    work(begin, std::min(n, begin + chunk_size), chunk);
  }
}

/// Calls work(i) for i in [0, n): each thread has a run of them, the same one in every call.
template <class Work>
void for_shares(std::int64_t n, const Work& work) {
#pragma omp parallel for schedule(static) if (n > 1)
  for (std::int64_t i = 0; i < n; ++i)
    work(i);
}

/// Sum of partial results in their order.
template <class T>
T sum_in_order(const std::vector<T>& parts) {
  T sum{};
  for (const T& part : parts)
    sum += part;
  return sum;
}

}  // namespace diptych::parallel
