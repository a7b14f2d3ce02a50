#pragma once
/// Sums and extremes over a body, of numbers of its chunks: each rank has those of its own chunks,
/// and all get the results, in one message whose length does not depend on the body. Sums are exact
/// until they are rounded (exact_sum.hpp), so that they have the same bits for every number of
/// ranks. Test: tests/common/parallel/reduction_test.cpp

#include "common/parallel/exact_sum.hpp"
#include "common/parallel/part.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <vector>

namespace diptych::parallel {

/// Calls use(chunk) for the chunks of this part, of n_chunks.
template <class Use>
void for_own_chunks(const Part& part, std::int64_t n_chunks, const Use& use) {
  if (part.is_whole()) {
    for (std::int64_t chunk = 0; chunk < n_chunks; ++chunk)
      use(static_cast<size_t>(chunk));
    return;
  }
  for (const std::int64_t chunk : part.own_chunks())
    use(static_cast<size_t>(chunk));
}

class Reduction {
 public:
  explicit Reduction(const Part& part) : part_(part) { sums_.reserve(usual_number); }

  /// @param of_chunks  [chunk], those of other parts are not read
  /// @param result     set by finish(), which it must outlive
  void sum(const std::vector<double>& of_chunks, double& result);
  /// NaN where one is, as the least is.
  void largest(const std::vector<double>& of_chunks, double& result);
  void least(const std::vector<double>& of_chunks, double& result);

  /// A sum to which the caller adds what is of this part.
  /// @return  its number: 0, 1, ..
  size_t new_sum(double& result);
  void add(size_t sum, double x) { sums_[sum].exact.add(x); }

  /// Brings together what the ranks have: all call this together, and have asked for the same.
  void finish();

 private:
  static constexpr size_t usual_number = 4;
  struct Sum {
    ExactSum exact;
    double* result;
  };
  struct Extreme {
    std::int64_t key;  // of the largest of sign times the numbers
    double sign;
    double* result;
  };
  void extreme(const std::vector<double>& of_chunks, double sign, double& result);

  const Part& part_;
  std::vector<Sum> sums_;
  std::vector<Extreme> extremes_;
};

/// Sum of records that are made of doubles and of nothing else.
/// @param for_own  for_own(use) calls use(record) for those of this part
template <class Record, class ForOwn>
Record sum_of_own(const Part& part, const ForOwn& for_own) {
  static_assert(sizeof(Record) % sizeof(double) == 0);
  std::array<double, sizeof(Record) / sizeof(double)> totals, numbers;
  Reduction reduction(part);
  for (double& total : totals)
    reduction.new_sum(total);
  for_own([&](const Record& record) {
    std::memcpy(numbers.data(), static_cast<const void*>(&record), sizeof(Record));
    for (size_t i = 0; i < numbers.size(); ++i)
      reduction.add(i, numbers[i]);
  });
  reduction.finish();
  Record sum;
  std::memcpy(static_cast<void*>(&sum), totals.data(), sizeof(Record));
  return sum;
}

/// @param of_chunks  [chunk], those of other parts are not read
template <class Record>
Record sum_of_chunks(const Part& part, const std::vector<Record>& of_chunks) {
  return sum_of_own<Record>(part, [&](const auto& use) {
    for_own_chunks(part, std::ssize(of_chunks), [&](size_t chunk) { use(of_chunks[chunk]); });
  });
}

/// Sum over a list of nodes: add(k, sum) of the entries that are of this part, group by group.
/// @param add  changes nothing but the sum, and what belongs to entry k
template <class Record, class Add>
Record sum_over(const Part& part, const ChunksOfList& list, const Add& add) {
  std::vector<Record> parts(list.chunk.size());
  for_shares(list.n_groups(), [&](std::int64_t group) {
    if (!part.owns(list.chunk[group])) return;
    for (std::int64_t k = list.first[group]; k < list.first[group + 1]; ++k)
      add(list.entry[k], parts[group]);
  });
  return sum_of_own<Record>(part, [&](const auto& use) {
    for (std::int64_t group = 0; group < list.n_groups(); ++group)
      if (part.owns(list.chunk[group])) use(parts[group]);
  });
}

}  // namespace diptych::parallel
