#pragma once
/// First pair sweep of an evaluation, after F, H, J have been moved to its time: strain rates
/// (18b), then per node relaxation (14), stress (9) and wave speeds, left where the momentum sweep
/// reads them. (18c) and (18d) are pointwise in dF/dt and stand in the update. The sum over pairs
/// (strain_sum.hpp) knows no material; what a block does with it is compiled for each
/// (compiled_material.hpp).

#include "common/scheme/body/material_model.hpp"
#include "common/scheme/body/relaxation.hpp"
#include "common/scheme/body/stage_combination.hpp"
#include "common/scheme/ranks/share.hpp"

namespace diptych::scheme {

/// What the blocks of a chunk add up.
struct BlockTotals {
  algebra::Lanes least_J = algebra::Lanes{} + 1e300;
  bool is_sound = true;            ///< every node is (compiled_material.hpp)
  double viscous_dissipation = 0;  ///< J, of the step that ends here
  double old_power = 0;            ///< W, see StrainRateSweep
};

template <int Dim>
struct StrainRateSweep {
  Body<Dim>& body;
  const MaterialModel& material;
  const Relaxation& relaxation;
  double face_correction;  ///< kappa_f, 0: none; else body.gradients hold the uncorrected dF/dt
  const StageCombination* stage;  ///< SSP: moves F, H, J by the old rates first; may be null
  double drift;                   ///< s, leapfrog: moves u, F, H, J by the new rates
  // results, one per chunk of parallel::for_chunks
  double* viscous_dissipation;  ///< J
  double* least_J;              ///< NaN where a node is not sound (compiled_material.hpp)
  /// W, leapfrog: of the forces before with the velocities of the drift, sum v . T + Omega P : L of
  /// the T and P that are replaced; what central forces do cancels. May be null
  double* old_power = nullptr;
};

/// The sweep over the blocks of a share.
template <int Dim>
void evaluate_strain_rates(const StrainRateSweep<Dim>& sweep, Share share = Share::whole);

/// The compiled sweep over the blocks of a chunk.
template <int Dim>
using StrainRateFunction = void (*)(const StrainRateSweep<Dim>& sweep,
                                    std::int64_t begin,
                                    std::int64_t end,
                                    std::int64_t chunk);
template <int Dim>
StrainRateFunction<Dim> strain_rate_function();

/// dF/dt (18b) of the velocities as they stand into the records, and nothing else: for set-up,
/// where v stands for another field. With the face correction where kappa_f is not zero.
template <int Dim>
void velocity_gradients(Body<Dim>& body, double kappa_f);

}  // namespace diptych::scheme
