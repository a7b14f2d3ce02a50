#pragma once
/// Parallel loops of few, large items, such as layers of a body; see for_chunks.hpp for loops over
/// nodes.

#include <cstdint>
#include <exception>

namespace diptych::parallel {

/// Calls work(i) for i in [0, n), in any order. Of what they throw, one is thrown on at the end.
template <class Work>
void for_each(std::int64_t n, const Work& work) {
  std::exception_ptr thrown;
#pragma omp parallel for schedule(dynamic, 1) if (n > 1)
  for (std::int64_t i = 0; i < n; ++i) {
    try {
      work(i);
    } catch (...) {
#pragma omp critical(diptych_for_each)
      thrown = std::current_exception();
    }
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace diptych::parallel
