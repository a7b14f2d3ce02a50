/// Memory of a run: what earlier runs hold is none of it.

#include "benchmarks/run/memory.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace diptych::harness {
namespace {

constexpr std::int64_t large = 64 << 20, small = 8 << 20;
/// The kernel adds what a thread has touched to the account of the process 64 pages at a time.
constexpr std::int64_t unaccounted = 64 * 4096;

TEST(RunMemory, IsThatOfTheRunWhateverEarlierOnesHoldOrHadForAMoment) {
  const RunMemory first;
  const std::int64_t at_first = first.settled();
  const std::vector<char> kept(large, 1);
  { const std::vector<char> passing(large, 1); }
  EXPECT_GE(first.peak() - at_first, 2 * large - unaccounted);

  const RunMemory second;
  EXPECT_NEAR(static_cast<double>(second.settled()), static_cast<double>(at_first), 0.5 * small);
  const std::vector<char> own(small, 1);
  EXPECT_GE(second.peak() - at_first, small / 2);
  EXPECT_LT(second.peak() - at_first, 2 * small) << "counts what the first run has";
  EXPECT_EQ(kept.back() + own.back(), 2);
}

}  // namespace
}  // namespace diptych::harness
