#pragma once
/// Second pair sweep of an evaluation: internal forces of (18a) with the dissipation D_ab,
///   T_a = sum_b 1/2 (P_a C_ab - P_b C_ba) + sum_b D_ab.
/// Runs: every pair is worked once, from its lower node, and its force added to one node and taken
/// from the other. Segments of blocks go no farther than into the next segment: all even ones are
/// worked at the same time, then all odd ones, so that no node is written by two threads and every
/// sum has an order of its own. Rows: every pair is worked twice, each time for one of its nodes,
/// with P_a sum_b C_ab taken out of the sum.
///
/// The formulas of a pair are in pair_forces.hpp, the two forms of the sweep in momentum_rows.hpp
/// and momentum_runs.hpp, what is compiled in compiled/momentum.hpp.
///
/// Also per node: numerical dissipation 1/2 sum_b (v_b - v_a).D_ab, and on demand the graph CFL
/// rate sum_b |C_ab| c_ab / (2 Omega_a) with c_ab = max(c_p,a, c_p,b) (notes 2.1).
///
/// Cost in 3-D (linear reconstruction, isotropic): about 75 multiply-adds for a directed pair of
/// rows, about 90 for both directions in runs, on 280 bytes of the neighbour; geometry at most 44
/// bytes of a directed pair in rows, 26 in runs.

#include "common/scheme/body/body.hpp"
#include "common/scheme/dissipation/dissipation.hpp"
#include "common/scheme/ranks/run_work.hpp"
#include "common/scheme/ranks/share.hpp"

#include <functional>

namespace diptych::scheme {

/// Arguments and results of the sweep.
template <int Dim>
struct MomentumSweep {
  Body<Dim>& body;
  double factor;    ///< multiplies D_ab
  bool with_bound;  ///< fill largest_rate
  // results, one per chunk of parallel::for_chunks
  double* numerical_power;  ///< W
  double* largest_rate;     ///< 1/s, graph CFL: dt <= 1/rate
  double* limited_pairs;    ///< whose jump the limiter has changed
};

/// A compiled sweep over blocks [begin, end) of a chunk: forces of rows into state.T, of runs added
/// to its sums.
template <int Dim>
using MomentumFunction = void (*)(const MomentumSweep<Dim>& sweep,
                                  std::int64_t begin,
                                  std::int64_t end,
                                  std::int64_t chunk);

/// The menu of compiled sweeps of one dimension and impedance, by reconstruction and limiter:
/// compiled/momentum.hpp, compiled in a file of its own for each.
template <int Dim, Impedance impedance, bool has_H>
MomentumFunction<Dim> momentum_sweep_of(const DissipationKind& kind);

/// The same of jump_adjoint.hpp, whose reconstruction is symmetric.
template <int Dim, Impedance impedance, bool has_H>
MomentumFunction<Dim> moments_sweep_of();

/// The compiled sweep of this kind. has_H: the material's pressure wave is polarised along H N.
template <int Dim>
MomentumFunction<Dim> momentum_function(const DissipationKind& kind, bool has_H);

/// The sweep over the blocks of a share: internal forces into state.T.
template <int Dim>
void sum_forces(const MomentumSweep<Dim>& sweep,
                MomentumFunction<Dim> momentum,
                Share share = Share::whole);

/// Makes the records of the blocks [begin, end) of a chunk.
using MakeRecords = std::function<void(std::int64_t begin, std::int64_t end, std::int64_t chunk)>;

/// Runs: makes the records of all blocks and sums the forces in the same pass, those of a chunk
/// while the records that they read are in the caches (graph/work_order.hpp). The same bits as one
/// after the other. Not among ranks.
/// @pre the records of a chunk need T of its own nodes at most, which sums replace
template <int Dim>
void sum_forces_of_stage(const MomentumSweep<Dim>& sweep,
                         MomentumFunction<Dim> momentum,
                         const MakeRecords& make_records);

/// The same of a rank, a share after the other (ranks/run_work.hpp).
template <int Dim>
void sum_forces_of_stage(const MomentumSweep<Dim>& sweep,
                         MomentumFunction<Dim> momentum,
                         const MakeRecords& make_records,
                         StageShare share);

/// The compiled sweep of jump_adjoint.hpp.
template <int Dim>
MomentumFunction<Dim> moments_function(Impedance impedance, bool has_H);

/// That sweep over the blocks of a share: N/Omega into state.moments.
template <int Dim>
void sum_moments(const MomentumSweep<Dim>& sweep,
                 MomentumFunction<Dim> moments,
                 Share share = Share::whole);

/// After all shares: P of the records becomes P - N/Omega.
template <int Dim>
void take_moments(Body<Dim>& body);

}  // namespace diptych::scheme
