/// In which order chunks of runs are worked: what may be worked at the same time has nothing in
/// common, and records are made once, before the forces that read them.

#include "common/scheme/graph/work_order.hpp"

#include "common/parallel/for_chunks.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace diptych::tests {
namespace {

using algebra::Vec3;
using scheme::WorkOrder;

/// Chunks that the forces of a chunk read and add to.
std::set<std::int64_t> reached(const scheme::PairRuns& upward, std::int64_t chunk) {
  const std::int64_t n_blocks = std::ssize(upward.row) - 1;
  std::set<std::int64_t> chunks{chunk};
  const std::int64_t end = std::min(n_blocks, (chunk + 1) * parallel::chunk_size);
  for (std::int64_t b = chunk * parallel::chunk_size; b < end; ++b) {
    for (std::int64_t k = upward.row[b]; k < upward.row[b + 1]; ++k) {
      for (int lane = 0; lane < algebra::n_lanes; ++lane) {
        const std::int64_t node = b * algebra::n_lanes + lane + upward.offset[k];
        const std::int64_t block = std::min(node / algebra::n_lanes, n_blocks - 1);
        chunks.insert(block / parallel::chunk_size);
      }
    }
  }
  return chunks;
}

class Orders : public testing::TestWithParam<std::tuple<std::string, std::array<int, 3>>> {};

TEST_P(Orders, RecordsComeOnceAndBeforeTheForcesThatReadThem) {
  const auto& [method, cells] = GetParam();
  const scheme::PairGraph graph = graph_of(
      method, meshes::box(meshes::CellType::hexahedron, Vec3::Zero(), Vec3::Ones(), cells));
  const scheme::PairRuns upward = scheme::upward(scheme::find_runs(graph));
  const WorkOrder order = scheme::work_order(upward);
  const std::int64_t n_chunks = parallel::n_chunks_of(std::ssize(upward.row) - 1);
  // supports reach through all of the smallest one, whose pairs have no layers
  if (cells[0] > 3) {
    EXPECT_EQ(order.layer, (cells[0] + 1) * (cells[1] + 1));
  }
  EXPECT_EQ(order.has_large_layers(), cells[0] == 63);

  std::vector<std::int32_t> all(static_cast<size_t>(n_chunks)), forces = order.forces;
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(forces == all, !order.has_large_layers());
  std::sort(forces.begin(), forces.end());
  EXPECT_EQ(forces, all);

  std::vector<char> is_made(static_cast<size_t>(n_chunks));
  for (const std::int64_t parity : {0, 1}) {
    std::set<std::int64_t> of_others;
    for (std::int64_t s = parity; s < order.n_segments(); s += 2) {
      std::set<std::int64_t> touched;
      std::vector<std::int32_t> of_segment;
      for (const std::int32_t turn : order.stage_of(s)) {
        if (turn < 0) {
          EXPECT_EQ(is_made[~turn], 0) << "records made twice";
          is_made[~turn] = 1;
          touched.insert(~turn);
          continue;
        }
        of_segment.push_back(turn);
        for (const std::int64_t chunk : reached(upward, turn)) {
          EXPECT_EQ(is_made[chunk], 1) << "forces before records";
          touched.insert(chunk);
        }
      }
      const auto expected = order.forces_of(s);
      EXPECT_TRUE(
          std::equal(of_segment.begin(), of_segment.end(), expected.begin(), expected.end()));
      for (const std::int64_t chunk : touched)
        EXPECT_TRUE(of_others.insert(chunk).second) << "two segments at the same time";
    }
  }
  EXPECT_EQ(std::count(is_made.begin(), is_made.end(), 1), n_chunks);
}

INSTANTIATE_TEST_SUITE_P(Lattices,
                         Orders,
                         testing::Combine(testing::Values("sph", "fvm"),
                                          testing::Values(std::array{3, 3, 3},
                                                          std::array{14, 14, 14},
                                                          std::array{63, 33, 9})));

}  // namespace
}  // namespace diptych::tests
