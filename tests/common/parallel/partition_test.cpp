/// Chunks of a body among ranks, and sums over what they own.

#include "common/parallel/partition.hpp"

#include "common/base/error.hpp"
#include "common/parallel/part.hpp"
#include "common/parallel/ranks.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <set>

namespace diptych::parallel {
namespace {

/// A box of nx by ny by nz chunks, each with its neighbours along the axes, one of them dearer.
ChunkGraph box(int nx, int ny, int nz) {
  ChunkGraph graph;
  graph.row.push_back(0);
  const auto number = [&](int i, int j, int k) { return (k * ny + j) * nx + i; };
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        graph.work.push_back(i == 0 ? 15 : 10);
        graph.centre.push_back({1.0 * i, 1.0 * j, 1.0 * k});
        const auto add = [&](bool is_there, int neighbour) {
          if (!is_there) return;
          graph.neighbour.push_back(neighbour);
          graph.weight.push_back(4);
        };
        add(k > 0, number(i, j, k - 1));
        add(j > 0, number(i, j - 1, k));
        add(i > 0, number(i - 1, j, k));
        add(i + 1 < nx, number(i + 1, j, k));
        add(j + 1 < ny, number(i, j + 1, k));
        add(k + 1 < nz, number(i, j, k + 1));
        graph.row.push_back(std::ssize(graph.neighbour));
      }
    }
  }
  return graph;
}

bool has_module() {
  return std::filesystem::exists(tests::build_folder() + "/" + ranks_module_file);
}

class Partitions : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "metis" && !has_module()) GTEST_SKIP() << "MPI and METIS are not built";
  }
  std::vector<int> owners(const ChunkGraph& graph, int n_parts) const {
    return partitioners().at(GetParam())(graph, n_parts);
  }
};

TEST_P(Partitions, GiveEveryPartAboutTheSameWork) {
  const ChunkGraph graph = box(8, 8, 12);
  for (const int n : {1, 2, 3, 5, 8}) {
    const std::vector<int> owner = owners(graph, n);
    ASSERT_EQ(owner.size(), graph.work.size());
    const std::set<int> parts(owner.begin(), owner.end());
    EXPECT_EQ(parts.size(), static_cast<size_t>(n));
    EXPECT_EQ(*parts.begin(), 0);
    EXPECT_EQ(*parts.rbegin(), n - 1);
    EXPECT_LT(imbalance(graph, owner, n), 1.08) << n;
  }
}
TEST_P(Partitions, LeaveNoPartEmptyWhereThereAreHardlyMoreChunks) {
  for (const int n : {2, 3, 5, 6}) {
    const std::vector<int> owner = owners(box(3, 2, 1), n);
    EXPECT_EQ(std::set<int>(owner.begin(), owner.end()).size(), static_cast<size_t>(n)) << n;
  }
}
TEST_P(Partitions, OfGreatWorkAreThoseOfLittle) {
  ChunkGraph graph = box(8, 8, 12);
  const std::vector<int> little = owners(graph, 5);
  for (std::int64_t& work : graph.work)
    work *= std::int64_t{1} << 40;
  for (std::int64_t& weight : graph.weight)
    weight *= std::int64_t{1} << 40;
  const std::vector<int> owner = owners(graph, 5);
  EXPECT_LE(imbalance(graph, owner, 5), imbalance(graph, little, 5) + 0.02);
}
TEST_P(Partitions, AreTheSameTwice) {
  const ChunkGraph graph = box(7, 5, 9);
  EXPECT_EQ(owners(graph, 5), owners(graph, 5));
}
INSTANTIATE_TEST_SUITE_P(OfAMenu,
                         Partitions,
                         testing::ValuesIn(partitioners().names()),
                         [](const auto& tested) { return tested.param; });

TEST(Partitioners, AreAskedByName) {
  EXPECT_THROW(partitioners().at("slabs"), base::InputError);
}

TEST(ChunksOfList, HaveTheEntriesOfAChunkInTheirOrder) {
  const ChunksOfList list({4, 1, 4, 1, 7});
  EXPECT_EQ(list.chunk, (std::vector<std::int32_t>{1, 4, 7}));
  EXPECT_EQ(list.first, (std::vector<std::int64_t>{0, 2, 4, 5}));
  EXPECT_EQ(list.entry, (std::vector<std::int64_t>{1, 3, 0, 2, 4}));
  EXPECT_EQ(ChunksOfList(std::vector<std::int64_t>{}).n_groups(), 0);
}

/// Two ranks in one process: what the other one has is known beforehand.
class OtherHalf : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 2; }
  void begin_exchange(std::span<const Parcel>, std::span<const Parcel>) override {}
  void finish_exchange() override {}
  void all_gather(std::byte* all, std::span<const std::int64_t> bytes) override {
    const double theirs[] = {20, 40};
    ASSERT_EQ(bytes[1], static_cast<std::int64_t>(sizeof theirs));
    std::memcpy(all + bytes[0], theirs, sizeof theirs);
  }
  void reduce(std::span<std::int64_t>, std::span<std::int64_t>) override {}
  void broadcast(std::byte*, std::int64_t) override {}
  void meet() override {}
  CommunicationCost cost() const override { return {}; }
  void abort(int) override { std::abort(); }
};

TEST(Part, TakesFromOthersWhatTheyOwn) {
  OtherHalf ranks;
  const Part part(ranks, {0, 1, 0, 1, 0});
  std::vector<double> values{1, 0, 3, 0, 5};
  part.complete(values);
  EXPECT_EQ(values, (std::vector<double>{1, 20, 3, 40, 5}));
  std::vector<std::int64_t> chunks;
  for_chunks(part, 5 * chunk_size - 3, [&](std::int64_t begin, std::int64_t end, std::int64_t c) {
    EXPECT_EQ(begin, c * chunk_size);
    EXPECT_EQ(end, std::min(5 * chunk_size - 3, begin + chunk_size));
#pragma omp critical
    chunks.push_back(c);
  });
  std::sort(chunks.begin(), chunks.end());
  EXPECT_EQ(chunks, (std::vector<std::int64_t>{0, 2, 4}));
}

}  // namespace
}  // namespace diptych::parallel
