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

extern template MomentumFunction<2> moments_sweep_of<2, Impedance::isotropic, true>();
extern template MomentumFunction<2> moments_sweep_of<2, Impedance::exact, true>();
extern template MomentumFunction<2> moments_sweep_of<2, Impedance::exact, false>();
extern template MomentumFunction<3> moments_sweep_of<3, Impedance::isotropic, true>();
extern template MomentumFunction<3> moments_sweep_of<3, Impedance::exact, true>();
extern template MomentumFunction<3> moments_sweep_of<3, Impedance::exact, false>();

template <int Dim>
MomentumFunction<Dim> moments_function(Impedance impedance, bool has_H) {
  if (impedance == Impedance::isotropic) return moments_sweep_of<Dim, Impedance::isotropic, true>();
  return has_H ? moments_sweep_of<Dim, Impedance::exact, true>()
               : moments_sweep_of<Dim, Impedance::exact, false>();
}

template <int Dim>
MomentumFunction<Dim> momentum_function(const DissipationKind& kind, bool has_H) {
  if (kind.impedance == Impedance::isotropic) {
    return momentum_sweep_of<Dim, Impedance::isotropic, true>(kind);
  }
  return has_H ? momentum_sweep_of<Dim, Impedance::exact, true>(kind)
               : momentum_sweep_of<Dim, Impedance::exact, false>(kind);
}

namespace {

/// Calls work(begin, end) with the blocks of a chunk.
template <int Dim, class Work>
void with_blocks(const Body<Dim>& body, std::int64_t chunk, const Work& work) {
  const std::int64_t begin = chunk * parallel::chunk_size;
  work(begin, std::min(body.n_blocks, begin + parallel::chunk_size));
}

/// Runs: what segment s adds to its own nodes and those of the next.
template <int Dim>
void work_segment(const MomentumSweep<Dim>& sweep, MomentumFunction<Dim> momentum, std::int64_t s) {
  for (const std::int32_t chunk : sweep.body.graph.mutual.order.forces_of(s)) {
    with_blocks(sweep.body, chunk,
                [&](auto begin, auto end) { momentum(sweep, begin, end, chunk); });
  }
}

/// What a sweep over pairs adds up in runs.
template <int Dim>
struct RunSums {
  NodeTable& table;
  int n_components;
  /// makes what is asked of the sums of blocks [begin, end)
  void (*use)(const MomentumSweep<Dim>& sweep, std::int64_t begin, std::int64_t end);
};

template <int Dim>
void clear(const RunSums<Dim>& of, std::int64_t begin, std::int64_t end) {
  const std::int64_t stride = of.table.component_stride();
  of.table.visit([&](auto* sums) {
    for (int c = 0; c < of.n_components; ++c)
      std::fill(sums + c * stride + begin * n_lanes, sums + c * stride + end * n_lanes, 0);
  });
}

/// T from the sums of [begin, end), and the largest rate of each chunk.
template <int Dim>
DIPTYCH_CLONES void put_forces(const MomentumSweep<Dim>& sweep,
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

/// N/Omega from the sums of [begin, end).
template <int Dim>
DIPTYCH_CLONES void put_moments(const MomentumSweep<Dim>& sweep,
                                std::int64_t begin,
                                std::int64_t end) {
  NodeTable& moments = sweep.body.moments;
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes scale = 0.25 * algebra::load(sweep.body.graph.inverse_Omega.data() + b * n_lanes);
    for (int k = 0; k < Dim * Dim; ++k)
      moments.put(b, k, scale * moments.get(b, k));
  }
}

/// All even segments, then all odd ones.
template <int Dim>
class Segments {
 public:
  explicit Segments(const Body<Dim>& body)
      : n_blocks_(body.n_blocks),
        length_(body.graph.mutual.order.segment),
        n_(body.graph.mutual.order.n_segments()) {}
  /// First block.
  std::int64_t begin(std::int64_t s) const { return std::min(n_blocks_, s * length_); }
  template <class Work>
  void for_even(const Work& work) const {
    parallel::for_shares((n_ + 1) / 2, [&](std::int64_t i) { work(2 * i); });
  }
  template <class Work>
  void for_odd(const Work& work) const {
    parallel::for_shares(n_ / 2, [&](std::int64_t i) { work(2 * i + 1); });
  }

 private:
  std::int64_t n_blocks_, length_, n_;
};

template <int Dim>
void sum_runs(const MomentumSweep<Dim>& sweep,
              MomentumFunction<Dim> work,
              const RunSums<Dim>& sums) {
  const Segments<Dim> segments(sweep.body);
  segments.for_even([&](std::int64_t s) {
    clear(sums, segments.begin(s), segments.begin(s + 2));
    work_segment(sweep, work, s);
    if (s == 0) sums.use(sweep, segments.begin(0), segments.begin(1));
  });
  segments.for_odd([&](std::int64_t s) {
    work_segment(sweep, work, s);
    sums.use(sweep, segments.begin(s), segments.begin(s + 2));
  });
}

/// A stage of chunks: their records, which come where forces are to be added, and their forces.
template <int Dim>
struct StageWork {
  const MomentumSweep<Dim>& sweep;
  MomentumFunction<Dim> forces;
  const RunSums<Dim>& sums;
  const MakeRecords& make_records;

  void records_of(std::int64_t chunk) const {
    with_blocks(sweep.body, chunk, [&](auto begin, auto end) {
      make_records(begin, end, chunk);
      clear(sums, begin, end);
    });
  }
  void forces_of(std::int64_t chunk) const {
    with_blocks(sweep.body, chunk, [&](auto begin, auto end) { forces(sweep, begin, end, chunk); });
  }
  /// As WorkOrder::stage has them.
  void turns(std::span<const std::int32_t> turns) const {
    for (const std::int32_t turn : turns) {
      if (turn < 0) {
        records_of(~turn);
      } else {
        forces_of(turn);
      }
    }
  }
  /// Sums that have ended.
  void use(std::span<const std::int32_t> chunks) const {
    for (const std::int32_t chunk : chunks)
      with_blocks(sweep.body, chunk, [&](auto begin, auto end) { sums.use(sweep, begin, end); });
  }
};

/// The same in the order of a stage.
template <int Dim>
void sum_runs_of_stage(const StageWork<Dim>& work) {
  const auto& [sweep, forces, sums, make_records] = work;
  const WorkOrder& order = sweep.body.graph.mutual.order;
  const Segments<Dim> segments(sweep.body);
  segments.for_even([&](std::int64_t s) {
    work.turns(order.stage_of(s));
    if (s == 0) sums.use(sweep, segments.begin(0), segments.begin(1));
  });
  segments.for_odd([&](std::int64_t s) {
    work.turns(order.stage_of(s));
    sums.use(sweep, segments.begin(s), segments.begin(s + 2));
  });
}

/// The same of a rank.
template <int Dim>
void sum_runs_of_stage(const StageWork<Dim>& work, StageShare share) {
  const Body<Dim>& body = work.sweep.body;
  const RunWork& runs = body.division->runs;
  const auto for_segments = [&](std::span<const RankSegment> segments) {
    parallel::for_shares(std::ssize(segments), [&](std::int64_t i) {
      work.turns(segments[i].stage);
      work.use(segments[i].finished);
    });
  };
  const std::span even(runs.even);
  const auto n_secluded = static_cast<size_t>(runs.n_secluded),
             n_inner = static_cast<size_t>(runs.n_inner);
  switch (share) {
    case StageShare::secluded:
      // what is added to nodes of others is read by none
      parallel::for_shares(std::ssize(runs.written), [&](std::int64_t i) {
        if (body.part().owns(runs.written[i])) return;
        with_blocks(body, runs.written[i],
                    [&](auto begin, auto end) { clear(work.sums, begin, end); });
      });
      for_segments(even.first(n_secluded));
      return;
    case StageShare::border:
      parallel::for_shares(std::ssize(runs.border),
                           [&](std::int64_t i) { work.records_of(runs.border[i]); });
      return;
    case StageShare::inner:
      for_segments(even.subspan(n_secluded, n_inner - n_secluded));
      return;
    case StageShare::outer:
      for_segments(even.subspan(n_inner));
      parallel::for_shares(std::ssize(runs.finished), [&](std::int64_t i) {
        work.use(std::span(runs.finished).subspan(i, 1));
      });
      for_segments(runs.odd);
      return;
  }
}

/// The same of the chunks that write to nodes of this rank. An even segment is of one share, and
/// whichever is worked first, its sums have the same order.
template <int Dim>
void sum_runs_of_part(const MomentumSweep<Dim>& sweep,
                      MomentumFunction<Dim> work_chunk,
                      const RunSums<Dim>& sums,
                      Share share) {
  const RunWork& work = sweep.body.division->runs;
  const auto work_segments = [&](std::span<const RankSegment> segments) {
    parallel::for_shares(std::ssize(segments), [&](std::int64_t s) {
      for (const std::int32_t chunk : segments[s].forces) {
        with_blocks(sweep.body, chunk,
                    [&](auto begin, auto end) { work_chunk(sweep, begin, end, chunk); });
      }
    });
  };
  const std::span even(work.even);
  const auto n_inner = static_cast<size_t>(work.n_inner);
  if (share != Share::outer) {
    parallel::for_shares(std::ssize(work.written), [&](std::int64_t i) {
      with_blocks(sweep.body, work.written[i],
                  [&](auto begin, auto end) { clear(sums, begin, end); });
    });
    work_segments(even.first(n_inner));
  }
  if (share == Share::inner) return;
  work_segments(even.subspan(n_inner));
  work_segments(work.odd);
  for_chunks_of(sweep.body, Share::whole,
                [&](auto begin, auto end, auto) { sums.use(sweep, begin, end); });
}

template <int Dim>
void sum_pairs(const MomentumSweep<Dim>& sweep,
               MomentumFunction<Dim> work,
               const RunSums<Dim>& sums,
               Share share) {
  const bool runs = sweep.body.graph.shape.arrangement == Arrangement::runs;
  if (runs && sweep.body.division) {
    sum_runs_of_part(sweep, work, sums, share);
    return;
  }
  if (runs) {
    sum_runs(sweep, work, sums);
    return;
  }
  for_chunks_of(sweep.body, share,
                [&](auto begin, auto end, auto chunk) { work(sweep, begin, end, chunk); });
}

}  // namespace

template <int Dim>
void sum_forces(const MomentumSweep<Dim>& sweep, MomentumFunction<Dim> momentum, Share share) {
  sum_pairs<Dim>(sweep, momentum, {sweep.body.T, Dim + 1, put_forces<Dim>}, share);
}

template <int Dim>
void sum_forces_of_stage(const MomentumSweep<Dim>& sweep,
                         MomentumFunction<Dim> momentum,
                         const MakeRecords& make_records) {
  const RunSums<Dim> sums{sweep.body.T, Dim + 1, put_forces<Dim>};
  sum_runs_of_stage<Dim>({sweep, momentum, sums, make_records});
}

template <int Dim>
void sum_forces_of_stage(const MomentumSweep<Dim>& sweep,
                         MomentumFunction<Dim> momentum,
                         const MakeRecords& make_records,
                         StageShare share) {
  const RunSums<Dim> sums{sweep.body.T, Dim + 1, put_forces<Dim>};
  sum_runs_of_stage<Dim>({sweep, momentum, sums, make_records}, share);
}

template <int Dim>
void sum_moments(const MomentumSweep<Dim>& sweep, MomentumFunction<Dim> moments, Share share) {
  sum_pairs<Dim>(sweep, moments, {sweep.body.moments, Dim * Dim, put_moments<Dim>}, share);
}

template <int Dim>
void take_moments(Body<Dim>& body) {
  constexpr int n = Dim * Dim, P = NodeRecord<Dim>::P;
  for_chunks_of(body, Share::whole, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t b = begin; b < end; ++b) {
      Lanes stress[n];
      body.records.template get_each<n>(b, P,
                                        [&](int k, const Lanes& value) { stress[k] = value; });
      body.moments.template get_each<n>(b, 0,
                                        [&](int k, const Lanes& value) { stress[k] -= value; });
      body.records.template put_each<n>(b, P, [&](int k) { return stress[k]; });
    }
  });
}

template void sum_forces(const MomentumSweep<2>&, MomentumFunction<2>, Share);
template void sum_forces(const MomentumSweep<3>&, MomentumFunction<3>, Share);
template void sum_forces_of_stage(const MomentumSweep<2>&, MomentumFunction<2>, const MakeRecords&);
template void sum_forces_of_stage(const MomentumSweep<3>&, MomentumFunction<3>, const MakeRecords&);
template void sum_forces_of_stage(const MomentumSweep<2>&,
                                  MomentumFunction<2>,
                                  const MakeRecords&,
                                  StageShare);
template void sum_forces_of_stage(const MomentumSweep<3>&,
                                  MomentumFunction<3>,
                                  const MakeRecords&,
                                  StageShare);
template void sum_moments(const MomentumSweep<2>&, MomentumFunction<2>, Share);
template void sum_moments(const MomentumSweep<3>&, MomentumFunction<3>, Share);
template void take_moments(Body<2>&);
template void take_moments(Body<3>&);
template MomentumFunction<2> momentum_function<2>(const DissipationKind& kind, bool has_H);
template MomentumFunction<3> momentum_function<3>(const DissipationKind& kind, bool has_H);
template MomentumFunction<2> moments_function<2>(Impedance, bool);
template MomentumFunction<3> moments_function<3>(Impedance, bool);

}  // namespace diptych::scheme
