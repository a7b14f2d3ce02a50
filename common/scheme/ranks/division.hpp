#pragma once
/// A body among ranks. Every rank keeps the global numbers of nodes, blocks, chunks and segments
/// and works the chunks that it owns:
///   - sums over rows and all that is pointwise: of its own nodes, in the order that one rank has;
///   - forces of runs, where a pair is worked once for both nodes: the chunks that write to its own
///     nodes too, with the parity of their segments. What they write to nodes of others is never
///     read. So nothing is sent back, and the sums have their order.
///   - forces of cells: the same, with blocks of cells.
/// What sweeps read of other ranks' nodes comes by halos, whole, also where a lane multiplies it by
/// zero. The state so has the same bits for every number of ranks.
///
/// While a halo is on its way the rank works the chunks that read none of it (Share::inner), the
/// others once it is there. Test: tests/ranks

#include "common/parallel/halo.hpp"
#include "common/scheme/body/body.hpp"
#include "common/scheme/ranks/run_work.hpp"
#include "common/scheme/ranks/share.hpp"
#include "common/scheme/ranks/untouched.hpp"

#include <string>

namespace diptych::scheme {

struct Division {
  parallel::Part part;
  std::vector<std::int64_t> inner, outer;  ///< own chunks that sweeps over pairs work, by Share
  parallel::Halo pairs;                    ///< nodes that sweeps over pairs read
  parallel::Halo corners;                  ///< nodes that sweeps over cells read
  RunWork runs;
  std::vector<CellWork> cells;  ///< by group
  Untouched untouched;
  double imbalance = 1;  ///< largest work of a rank over the mean
};

/// Gives this rank its part. All ranks have the indices of the same graph; rank 0 decides.
/// @param partition  of parallel::partitioners()
/// @throws base::InputError where there are more ranks than chunks, on all ranks
template <int Dim>
void divide(Body<Dim>& body, parallel::Communicator& ranks, const std::string& partition);

/// Calls work(begin, end, chunk) for the chunks of blocks of a share of what the rank owns.
template <int Dim, class Work>
void for_chunks_of(const Body<Dim>& body, Share share, const Work& work) {
  if (share == Share::whole) {
    parallel::for_chunks(body.part(), body.n_blocks, work);
  } else {
    const Division& division = *body.division;
    parallel::for_chunks(share == Share::inner ? division.inner : division.outer, body.n_blocks,
                         work);
  }
}

/// For its lifetime a body is worked as if this rank were the only one: what is the same on all
/// ranks, or of rank 0 once all is gathered.
template <int Dim>
class Undivided {
 public:
  explicit Undivided(Body<Dim>& body) : body_(body), division_(std::move(body.division)) {
    body.division.reset();
  }
  ~Undivided() { body_.division = std::move(division_); }
  Undivided(const Undivided&) = delete;
  Undivided& operator=(const Undivided&) = delete;

 private:
  Body<Dim>& body_;
  std::shared_ptr<Division> division_;
};

}  // namespace diptych::scheme
