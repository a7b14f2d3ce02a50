#pragma once
/// What a rank works of the momentum sweep of runs, and when: the chunks that write to its own
/// nodes, by segments, in the order that one rank has (graph/work_order.hpp). Forces of a stage
/// follow the records of their chunks in the same pass, around two exchanges:
///   while velocities come    even segments that need nothing of others, secluded ones
///   then                     records of the chunks that others read, which are sent
///   while records come       even segments that read no record of others
///   then                     all others, the odd ones last.
/// Whichever even segment is worked first, every sum has its order. Test: tests/ranks,
/// tests/common/scheme/run_work_test.cpp

#include "common/parallel/part.hpp"
#include "common/scheme/graph/work_order.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych::scheme {

/// The chunks of a segment that a rank works.
struct RankSegment {
  std::vector<std::int32_t> forces;    ///< as all ranks order them
  std::vector<std::int32_t> stage;     ///< c: forces of chunk c, ~c: its records, own ones only
  std::vector<std::int32_t> finished;  ///< own chunks whose sums end with it, of odd ones only
};

struct RunWork {
  std::vector<RankSegment> even, odd;
  /// Of the even ones, the first: those that are worked while velocities come, and those that read
  /// no node of another rank, the former among them.
  std::int64_t n_secluded = 0, n_inner = 0;
  std::vector<std::int32_t> border;    ///< own chunks that read, or are read by, other ranks
  std::vector<std::int32_t> finished;  ///< own chunks whose sums end with the even segments
  std::vector<std::int64_t> written;   ///< chunks that segments write to, and the own ones
};

/// Which of the work, between the exchanges of a stage.
enum class StageShare { secluded, border, inner, outer };

/// @param row, offset  of upward runs
/// @param outer        own chunks that read nodes of others
/// @param sent         own chunks with nodes that others read
RunWork run_work(std::span<const std::int64_t> row,
                 std::span<const std::int32_t> offset,
                 const WorkOrder& order,
                 const parallel::Part& part,
                 const std::vector<std::int64_t>& outer,
                 const std::vector<std::int64_t>& sent);

}  // namespace diptych::scheme
