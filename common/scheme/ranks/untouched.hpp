#pragma once
/// What of a body a rank never reads or writes in its steps, as ranges of blocks, and giving its
/// memory back. Numbers stay global and arrays keep their length; their pages are those of the
/// rank's own nodes and of what it reads of others. Test: tests/ranks

#include "common/parallel/halo.hpp"
#include "common/parallel/pages.hpp"
#include "common/scheme/body/body.hpp"

#include <algorithm>
#include <vector>

namespace diptych::scheme {

/// Ranges of blocks, ascending.
using Blocks = std::vector<parallel::NodeRange>;

/// Whole chunks that hold no node of these kinds.
struct Untouched {
  Blocks owned;    ///< neither own ones,
  Blocks read;     ///< nor such that sweeps read of others,
  Blocks written;  ///< nor such that forces are added to;
  Blocks worked;   ///< none whose pairs are worked in the momentum sweep of runs
};

/// @param owned, read, written, worked  [n_chunks] not zero where a chunk is of that kind; what is
///                                      owned is of all of them
Untouched untouched_of(std::int64_t n_blocks,
                       const std::vector<char>& owned,
                       const std::vector<char>& read,
                       const std::vector<char>& written,
                       const std::vector<char>& worked);

/// What the rank does not touch of a field; nothing where there is one rank.
template <int Dim>
Blocks untouched_of(const Body<Dim>& body, const Field<Dim>& field);

/// use(a) of the nodes of [begin, end) that are in none of these blocks.
template <class Use>
void for_touched(const Blocks& untouched, std::int64_t begin, std::int64_t end, const Use& use) {
  auto gap = untouched.begin();
  for (std::int64_t a = begin; a < end;) {
    while (gap != untouched.end() && gap->end * algebra::n_lanes <= a)
      ++gap;
    const std::int64_t next =
        gap == untouched.end() ? end : std::min(end, gap->begin * algebra::n_lanes);
    for (; a < next; ++a)
      use(a);
    if (a < end) a = std::min(end, gap->end * algebra::n_lanes);
  }
}

/// Gives back what the rank does not touch of the fields: after they have been gathered or loaded.
/// @pre body.division
template <int Dim>
void release_fields(Body<Dim>& body);

/// The same of the graph, and of positions and volumes; they are gone for good. Positions stay
/// where volumes of cells or lines carry the pressure: a checkpoint that is loaded needs them all.
/// @pre body.division
template <int Dim>
void release_graph(Body<Dim>& body);

/// Gives back entries of blocks in an array with n_per_block for each.
template <class T>
void give_back_blocks(T* values,
                      std::int64_t size,
                      std::int64_t n_per_block,
                      const Blocks& untouched) {
  for (const parallel::NodeRange& blocks : untouched) {
    const std::int64_t begin = blocks.begin * n_per_block,
                       end = std::min(size, blocks.end * n_per_block);
    if (begin < end)
      parallel::give_back(parallel::bytes_of(values + begin),
                          (end - begin) * static_cast<std::int64_t>(sizeof(T)));
  }
}

/// Of blocks of a field.
inline void give_back_blocks(BlockField& field, const Blocks& untouched) {
  for (const parallel::NodeRange& blocks : untouched) {
    field.for_pieces(blocks.begin, blocks.end, [](std::byte* bytes, size_t n) {
      parallel::give_back(bytes, static_cast<std::int64_t>(n));
    });
  }
}

}  // namespace diptych::scheme
