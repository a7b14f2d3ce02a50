/// What a rank works of the forces of runs and when: records once and before the forces that read
/// them, nothing that others have before it is there, and every sum in the order of one rank.

#include "common/scheme/ranks/run_work.hpp"

#include "common/parallel/for_chunks.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace diptych::tests {
namespace {

using algebra::Vec3;
using scheme::RankSegment;

/// A rank of several that has nothing to say.
class OneOf : public parallel::Communicator {
 public:
  OneOf(int rank, int size) : rank_(rank), size_(size) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void begin_exchange(std::span<const parallel::Parcel>,
                      std::span<const parallel::Parcel>) override {}
  void finish_exchange() override {}
  void all_gather(std::byte*, std::span<const std::int64_t>) override {}
  void reduce(std::span<std::int64_t>, std::span<std::int64_t>) override {}
  void broadcast(std::byte*, std::int64_t) override {}
  void meet() override {}
  parallel::CommunicationCost cost() const override { return {}; }
  void abort(int) override { std::abort(); }

 private:
  int rank_, size_;
};

/// Follows the work of a rank and notes what goes wrong.
class Follower {
 public:
  Follower(const scheme::PairRuns& upward, const parallel::Part& part, std::int64_t n_chunks)
      : part_(part), reached_(static_cast<size_t>(n_chunks)) {
    for (std::int64_t c = 0; c < n_chunks; ++c)
      scheme::find_reached(upward.row, upward.offset, c, reached_[c]);
  }

  void make_records(std::int64_t chunk) {
    EXPECT_TRUE(part_.owns(chunk)) << "records of another rank";
    EXPECT_TRUE(made_.insert(chunk).second) << "records made twice";
  }
  /// Segments that may be worked at the same time.
  void work(std::span<const RankSegment> segments) {
    std::set<std::int64_t> touched;
    for (const RankSegment& segment : segments) {
      std::set<std::int64_t> here;
      std::vector<std::int32_t> forces;
      for (const std::int32_t turn : segment.stage) {
        if (turn < 0) {
          make_records(~turn);
          here.insert(~turn);
          continue;
        }
        forces.push_back(turn);
        for (const std::int64_t at : reached_[turn]) {
          here.insert(at);
          EXPECT_TRUE(!part_.owns(at) || made_.contains(at)) << "forces before records";
          EXPECT_TRUE(has_others_ || part_.owns(at)) << "what others have is not there yet";
          EXPECT_FALSE(finished_.contains(at)) << "added to a sum that has been used";
        }
      }
      EXPECT_EQ(forces, segment.forces);
      worked_.insert(forces.begin(), forces.end());
      finish(segment.finished);
      for (const std::int64_t at : here)
        EXPECT_TRUE(touched.insert(at).second) << "two segments at the same time";
    }
  }
  void take_records_of_others() { has_others_ = true; }
  void finish(const std::vector<std::int32_t>& chunks) {
    for (const std::int32_t c : chunks)
      EXPECT_TRUE(part_.owns(c) && finished_.insert(c).second);
  }
  void expect_all_done() const {
    const std::set<std::int64_t> own(part_.own_chunks().begin(), part_.own_chunks().end());
    EXPECT_EQ(made_, own);
    EXPECT_EQ(finished_, own);
    for (std::int64_t c = 0; c < std::ssize(reached_); ++c) {
      const bool is_needed = std::any_of(reached_[c].begin(), reached_[c].end(),
                                         [&](std::int64_t at) { return part_.owns(at); });
      EXPECT_EQ(worked_.contains(c), is_needed) << "chunk " << c;
    }
  }
  const std::vector<std::int64_t>& reached(std::int64_t c) const { return reached_[c]; }

 private:
  const parallel::Part& part_;
  std::vector<std::vector<std::int64_t>> reached_;
  std::set<std::int64_t> made_, worked_, finished_;
  bool has_others_ = false;
};

enum class Owners { slabs, every_third, one_has_all };

class RunWorkOf
    : public testing::TestWithParam<std::tuple<std::string, std::array<int, 3>, Owners>> {};

TEST_P(RunWorkOf, HasRecordsFirstAndKeepsTheOrderOfSums) {
  const auto& [method, cells, owners] = GetParam();
  const scheme::PairGraph graph = graph_of(
      method, meshes::box(meshes::CellType::hexahedron, Vec3::Zero(), Vec3::Ones(), cells));
  const scheme::PairRuns upward = scheme::upward(scheme::find_runs(graph));
  const scheme::WorkOrder order = scheme::work_order(upward);
  const std::int64_t n_chunks = std::ssize(order.forces);
  std::vector<int> owner(static_cast<size_t>(n_chunks));
  for (std::int64_t c = 0; c < n_chunks; ++c) {
    owner[c] = owners == Owners::slabs         ? static_cast<int>(3 * c / n_chunks)
               : owners == Owners::every_third ? static_cast<int>(c % 3)
                                               : 1;
  }
  for (int rank = 0; rank < 3; ++rank) {
    OneOf ranks(rank, 3);
    const parallel::Part part(ranks, owner);
    Follower follower(upward, part, n_chunks);
    std::set<std::int64_t> outer, sent;
    for (std::int64_t c = 0; c < n_chunks; ++c) {
      for (const std::int64_t at : follower.reached(c)) {
        if (part.owns(c) && !part.owns(at)) outer.insert(c);
        if (!part.owns(c) && part.owns(at)) sent.insert(at);
      }
    }
    const scheme::RunWork work =
        scheme::run_work(upward.row, upward.offset, order, part, {outer.begin(), outer.end()},
                         {sent.begin(), sent.end()});
    const std::span even(work.even);
    const auto secluded = even.first(static_cast<size_t>(work.n_secluded));
    for (const RankSegment& segment : secluded) {
      for (const std::int32_t c : segment.forces) {
        for (const std::int64_t at : follower.reached(c))
          EXPECT_TRUE(part.owns(at) && !outer.contains(at) && !sent.contains(at))
              << "needs velocities of others";
      }
    }
    follower.work(secluded);
    for (const std::int32_t c : work.border)
      follower.make_records(c);
    follower.work(
        even.subspan(secluded.size(), static_cast<size_t>(work.n_inner) - secluded.size()));
    follower.take_records_of_others();
    follower.work(even.subspan(static_cast<size_t>(work.n_inner)));
    follower.finish(work.finished);
    follower.work(work.odd);
    follower.expect_all_done();
    std::set<std::int64_t> written(part.own_chunks().begin(), part.own_chunks().end());
    for (const auto* segments : {&work.even, &work.odd}) {
      for (const RankSegment& segment : *segments) {
        for (const std::int32_t c : segment.forces)
          written.insert(follower.reached(c).begin(), follower.reached(c).end());
      }
    }
    EXPECT_EQ(work.written, std::vector<std::int64_t>(written.begin(), written.end()));
    if (owners == Owners::slabs && cells[2] == 60) {
      EXPECT_GT(work.n_secluded, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Lattices,
    RunWorkOf,
    testing::Combine(
        testing::Values("sph", "fvm"),
        testing::Values(std::array{3, 3, 3}, std::array{14, 14, 60}, std::array{63, 33, 9}),
        testing::Values(Owners::slabs, Owners::every_third, Owners::one_has_all)));

}  // namespace
}  // namespace diptych::tests
