#include "common/parallel/reduction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

namespace diptych::parallel {
namespace {

/// One rank of several in one process: keeps what it brings, and takes what was kept of all.
class Taking : public Communicator {
 public:
  struct Brought {
    std::vector<std::int64_t> sums, largest;
  };
  Taking(int rank, std::vector<Brought>& of_ranks) : rank_(rank), of_ranks_(of_ranks) {}
  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(of_ranks_.size()); }
  void begin_exchange(std::span<const Parcel>, std::span<const Parcel>) override {}
  void finish_exchange() override {}
  void all_gather(std::byte*, std::span<const std::int64_t>) override {}
  void reduce(std::span<std::int64_t> sums, std::span<std::int64_t> largest) override {
    of_ranks_[static_cast<size_t>(rank_)] = {{sums.begin(), sums.end()},
                                             {largest.begin(), largest.end()}};
    for (size_t r = 0; r < of_ranks_.size(); ++r) {
      if (static_cast<int>(r) == rank_ || of_ranks_[r].sums.empty()) continue;
      for (size_t i = 0; i < sums.size(); ++i)
        sums[i] += of_ranks_[r].sums[i];
      for (size_t i = 0; i < largest.size(); ++i)
        largest[i] = std::max(largest[i], of_ranks_[r].largest[i]);
    }
  }
  void broadcast(std::byte*, std::int64_t) override {}
  void meet() override {}
  CommunicationCost cost() const override { return {}; }
  void abort(int) override { std::abort(); }

 private:
  int rank_;
  std::vector<Brought>& of_ranks_;
};

/// What each of these ranks gets: once for what they bring, once more with it.
template <class Result>
std::vector<Result> of_ranks(const std::vector<int>& owner_of_chunk,
                             int n_ranks,
                             const std::function<Result(const Part&)>& work) {
  std::vector<Taking::Brought> brought(static_cast<size_t>(n_ranks));
  std::vector<Result> results(static_cast<size_t>(n_ranks));
  for (int round = 0; round < 2; ++round) {
    for (int rank = 0; rank < n_ranks; ++rank) {
      Taking ranks(rank, brought);
      results[static_cast<size_t>(rank)] = work(Part(ranks, owner_of_chunk));
    }
  }
  return results;
}

struct Results {
  double sum = 0, largest = 0, least = 0;
};

TEST(Reduction, IsTheSameOnAllRanksAndWithoutRanks) {
  const std::vector<double> numbers{0.1, -1e17, 0.7, 1e17, -3, 0.2, 5e-17};
  const auto work = [&](const Part& part) {
    std::vector<double> own = numbers;  // what is of others must not be read
    for (size_t chunk = 0; chunk < own.size(); ++chunk)
      if (!part.owns(static_cast<std::int64_t>(chunk))) own[chunk] = std::nan("");
    Results results;
    Reduction reduction(part);
    reduction.sum(own, results.sum);
    reduction.largest(own, results.largest);
    reduction.least(own, results.least);
    reduction.finish();
    return results;
  };
  const Results alone = work(Part());
  EXPECT_EQ(alone.sum, -2.0);  // 0.1 + 0.7 - 3 + 0.2 + 5e-17, which doubles round to
  EXPECT_EQ(alone.largest, 1e17);
  EXPECT_EQ(alone.least, -1e17);
  for (const std::vector<int>& owners :
       {std::vector<int>{0, 1, 0, 1, 2, 2, 0}, std::vector<int>{1, 1, 1, 0, 0, 0, 0}}) {
    for (const Results& of_rank : of_ranks<Results>(owners, 3, work)) {
      EXPECT_EQ(of_rank.sum, alone.sum);
      EXPECT_EQ(of_rank.largest, alone.largest);
      EXPECT_EQ(of_rank.least, alone.least);
    }
  }
}

TEST(Reduction, TellsWhereAnyIsNoNumber) {
  const std::vector<double> numbers{1, std::nan(""), -2};
  Results results;
  const Part whole;
  Reduction reduction(whole);
  reduction.sum(numbers, results.sum);
  reduction.largest(numbers, results.largest);
  reduction.least(numbers, results.least);
  reduction.finish();
  EXPECT_TRUE(std::isnan(results.sum));
  EXPECT_TRUE(std::isnan(results.largest));
  EXPECT_TRUE(std::isnan(results.least));
}

TEST(SumOfChunks, AddsRecordsNumberByNumber) {
  struct Record {
    double a = 0, b = 0;
  };
  const auto sum = sum_of_chunks<Record>(Part(), {{1e16, 1}, {1, 2}, {-1e16, 4}});
  EXPECT_EQ(sum.a, 1);
  EXPECT_EQ(sum.b, 7);
}

TEST(SumOver, TakesTheEntriesOfOwnChunks) {
  const ChunksOfList list({1, 0, 1, 2});
  const std::vector<double> value{1e16, 1, -1e16, 4};
  const auto add = [&](std::int64_t k, double& of_group) {
    of_group += value[static_cast<size_t>(k)];
  };
  EXPECT_EQ(sum_over<double>(Part(), list, add), 5);
  for (const double of_rank : of_ranks<double>(
           {0, 1, 0}, 2, [&](const Part& part) { return sum_over<double>(part, list, add); }))
    EXPECT_EQ(of_rank, 5);
}

}  // namespace
}  // namespace diptych::parallel
