#include "common/scheme/sweeps/momentum.hpp"

#include "common/parallel/for_chunks.hpp"
#include "common/scheme/body/pointwise.hpp"
#include "common/scheme/ranks/division.hpp"

#include <algorithm>

namespace diptych::scheme {

extern template MomentumFunction<2> momentum_sweep_of<2, Impedance::isotropic, true>(
    const DissipationKind&);
extern template MomentumFunction<3> momentum_sweep_of<3, Impedance::isotropic, true>(
    const DissipationKind&);
extern template MomentumFunction<2> momentum_sweep_of<2, Impedance::exact, true>(
    const DissipationKind&);
extern template MomentumFunction<3> momentum_sweep_of<3, Impedance::exact, true>(
    const DissipationKind&);
extern template MomentumFunction<2> momentum_sweep_of<2, Impedance::exact, false>(
    const DissipationKind&);
extern template MomentumFunction<3> momentum_sweep_of<3, Impedance::exact, false>(
    const DissipationKind&);

template <int Dim>
MomentumFunction<Dim> momentum_function(const DissipationKind& kind, bool has_H) {
  if (kind.impedance == Impedance::isotropic) {
    return momentum_sweep_of<Dim, Impedance::isotropic, true>(kind);
  }
  return has_H ? momentum_sweep_of<Dim, Impedance::exact, true>(kind)
               : momentum_sweep_of<Dim, Impedance::exact, false>(kind);
}

namespace {

/// Runs: what segment [begin, end) adds to its own nodes and those of the next.
template <int Dim>
void work_segment(const MomentumSweep<Dim>& sweep,
                  MomentumFunction<Dim> momentum,
                  std::int64_t begin,
                  std::int64_t end) {
  for (std::int64_t b = begin; b < end; b += parallel::chunk_size) {
    momentum(sweep, b, std::min(end, b + parallel::chunk_size), b / parallel::chunk_size);
  }
}

template <int Dim>
void clear_sums(Body<Dim>& body, std::int64_t begin, std::int64_t end) {
  const std::int64_t stride = body.T.component_stride();
  body.T.visit([&](auto* sums) {
    for (int c = 0; c <= Dim; ++c)
      std::fill(sums + c * stride + begin * n_lanes, sums + c * stride + end * n_lanes, 0);
  });
}

/// Runs: T from the sums of [begin, end), and the largest rate of each chunk.
template <int Dim>
DIPTYCH_CLONES void use_sums(const MomentumSweep<Dim>& sweep,
                             std::int64_t begin,
                             std::int64_t end) {
  Body<Dim>& body = sweep.body;
  const algebra::FlushToZero flush(body.is_single());
  for (std::int64_t b = begin; b < end; ++b) {
    for (int i = 0; i < Dim; ++i)
      body.T.put(b, i, 0.5 * body.T.get(b, i));
    if (!sweep.with_bound) continue;
    const Lanes rate = (0.5 / sweep.body.options.rho_R) * body.T.get(b, Dim) *
                       algebra::load(sweep.body.graph.inverse_Omega.data() + b * n_lanes);
    double& largest = sweep.largest_rate[b / parallel::chunk_size];
    for (int lane = 0; lane < n_lanes; ++lane)
      largest = algebra::larger(largest, rate[lane]);
  }
}

template <int Dim>
void sum_forces_of_runs(const MomentumSweep<Dim>& sweep, MomentumFunction<Dim> momentum) {
  const std::int64_t n = sweep.body.graph.n_blocks, length = sweep.body.graph.mutual.segment;
  const std::int64_t n_segments = (n + length - 1) / length;
  const auto begin = [&](std::int64_t segment) { return std::min(n, segment * length); };
  parallel::for_shares((n_segments + 1) / 2, [&](std::int64_t i) {
    const std::int64_t s = 2 * i;
    clear_sums(sweep.body, begin(s), begin(s + 2));
    work_segment(sweep, momentum, begin(s), begin(s + 1));
    if (s == 0) use_sums(sweep, begin(0), begin(1));
  });
  parallel::for_shares(n_segments / 2, [&](std::int64_t i) {
    const std::int64_t s = 2 * i + 1;
    work_segment(sweep, momentum, begin(s), begin(s + 1));
    use_sums(sweep, begin(s), begin(s + 2));
  });
}

/// The same of the chunks that write to nodes of this rank. An even segment is of one share, and
/// whichever is worked first, its sums have the same order.
template <int Dim>
void sum_forces_of_part(const MomentumSweep<Dim>& sweep,
                        MomentumFunction<Dim> momentum,
                        Share share) {
  const RunWork& work = sweep.body.division->runs;
  const auto end_of = [&](std::int64_t chunk) {
    return std::min(sweep.body.n_blocks, (chunk + 1) * parallel::chunk_size);
  };
  const auto work_segments = [&](std::span<const std::vector<std::int64_t>> segments) {
    parallel::for_shares(std::ssize(segments), [&](std::int64_t s) {
      for (const std::int64_t chunk : segments[s])
        momentum(sweep, chunk * parallel::chunk_size, end_of(chunk), chunk);
    });
  };
  const std::span even(work.segments[0]);
  if (share != Share::outer) {
    parallel::for_shares(std::ssize(work.written), [&](std::int64_t i) {
      const std::int64_t chunk = work.written[i];
      clear_sums(sweep.body, chunk * parallel::chunk_size, end_of(chunk));
    });
    work_segments(even.first(work.n_inner));
  }
  if (share == Share::inner) return;
  work_segments(even.subspan(work.n_inner));
  work_segments(work.segments[1]);
  for_chunks_of(sweep.body, Share::whole,
                [&](auto begin, auto end, auto) { use_sums(sweep, begin, end); });
}

}  // namespace

template <int Dim>
void sum_forces(const MomentumSweep<Dim>& sweep, MomentumFunction<Dim> momentum, Share share) {
  const bool runs = sweep.body.graph.shape.arrangement == Arrangement::runs;
  if (runs && sweep.body.division) {
    sum_forces_of_part(sweep, momentum, share);
    return;
  }
  if (runs) {
    sum_forces_of_runs(sweep, momentum);
    return;
  }
  for_chunks_of(sweep.body, share,
                [&](auto begin, auto end, auto chunk) { momentum(sweep, begin, end, chunk); });
}

template void sum_forces(const MomentumSweep<2>&, MomentumFunction<2>, Share);
template void sum_forces(const MomentumSweep<3>&, MomentumFunction<3>, Share);
template MomentumFunction<2> momentum_function<2>(const DissipationKind& kind, bool has_H);
template MomentumFunction<3> momentum_function<3>(const DissipationKind& kind, bool has_H);

}  // namespace diptych::scheme
