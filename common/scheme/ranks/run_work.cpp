#include "common/scheme/ranks/run_work.hpp"

#include <algorithm>

namespace diptych::scheme {

namespace {

/// Chunks that forces of each chunk read and add to.
using Reached = std::vector<std::vector<std::int64_t>>;

bool any_in(const std::vector<char>& kind, const std::vector<std::int64_t>& chunks) {
  return std::any_of(chunks.begin(), chunks.end(), [&](std::int64_t c) { return kind[c] != 0; });
}

/// Moves those first that `is_wanted`, and counts them.
template <class IsWanted>
std::int64_t put_first(std::span<RankSegment> segments, const IsWanted& is_wanted) {
  return std::stable_partition(segments.begin(), segments.end(), is_wanted) - segments.begin();
}

/// Fills in the stages of these segments, which are worked in this order or at the same time.
void add_stages(std::span<RankSegment> segments,
                const Reached& reached,
                const std::vector<char>& is_own,
                std::vector<char>& is_evaluated) {
  for (RankSegment& segment : segments) {
    for (const std::int32_t c : segment.forces) {
      for (const std::int64_t at : reached[c]) {
        if (is_own[at] != 0 && is_evaluated[at] == 0)
          segment.stage.push_back(~static_cast<std::int32_t>(at));
        is_evaluated[at] = 1;
      }
      segment.stage.push_back(c);
    }
  }
}

}  // namespace

RunWork run_work(std::span<const std::int64_t> row,
                 std::span<const std::int32_t> offset,
                 const WorkOrder& order,
                 const parallel::Part& part,
                 const std::vector<std::int64_t>& outer,
                 const std::vector<std::int64_t>& sent) {
  const std::int64_t n_chunks = std::ssize(order.forces);
  Reached reached(static_cast<size_t>(n_chunks));
  std::vector<char> works(reached.size()), written(reached.size()), is_own(reached.size());
  for (std::int64_t c = 0; c < n_chunks; ++c)
    is_own[c] = part.owns(c) ? 1 : 0;
  for (std::int64_t c = 0; c < n_chunks; ++c) {
    find_reached(row, offset, c, reached[c]);
    works[c] = any_in(is_own, reached[c]) ? 1 : 0;
    if (works[c] == 0) continue;
    for (const std::int64_t at : reached[c])
      written[at] = 1;
  }
  RunWork work;
  for (std::int64_t c = 0; c < n_chunks; ++c) {
    if (written[c] != 0) work.written.push_back(c);
  }

  const auto own_of = [&](std::int64_t s, std::vector<std::int32_t>& own) {
    if (s >= order.n_segments()) return;
    for (const std::int32_t c : order.forces_of(s)) {
      if (is_own[c] != 0) own.push_back(c);
    }
  };
  own_of(0, work.finished);
  for (std::int64_t s = 0; s < order.n_segments(); ++s) {
    RankSegment segment;
    for (const std::int32_t c : order.forces_of(s)) {
      if (works[c] != 0) segment.forces.push_back(c);
    }
    if (s % 2 == 1) {
      own_of(s, segment.finished);
      own_of(s + 1, segment.finished);
    }
    if (segment.forces.empty() && segment.finished.empty()) continue;
    (s % 2 == 0 ? work.even : work.odd).push_back(std::move(segment));
  }

  std::vector<char> reads_others(reached.size());
  for (size_t c = 0; c < reached.size(); ++c)
    reads_others[c] = 1 - is_own[c];
  for (const std::int64_t c : outer)
    reads_others[c] = 1;
  std::vector<char> border = reads_others;
  for (const std::int64_t c : sent)
    border[c] = 1;
  for (const std::int64_t c : part.own_chunks()) {
    if (border[c] != 0) work.border.push_back(static_cast<std::int32_t>(c));
  }
  const std::span even(work.even);
  work.n_inner = put_first(even, [&](const RankSegment& segment) {
    return std::none_of(segment.forces.begin(), segment.forces.end(),
                        [&](std::int32_t c) { return reads_others[c] != 0; });
  });
  work.n_secluded =
      put_first(even.first(static_cast<size_t>(work.n_inner)), [&](const RankSegment& segment) {
        return std::none_of(segment.forces.begin(), segment.forces.end(),
                            [&](std::int32_t c) { return any_in(border, reached[c]); });
      });

  std::vector<char> is_evaluated(reached.size());
  add_stages(even.first(static_cast<size_t>(work.n_secluded)), reached, is_own, is_evaluated);
  for (const std::int32_t c : work.border)
    is_evaluated[c] = 1;
  add_stages(even.subspan(static_cast<size_t>(work.n_secluded)), reached, is_own, is_evaluated);
  add_stages(work.odd, reached, is_own, is_evaluated);
  return work;
}

}  // namespace diptych::scheme
