#pragma once
/// The two sweeps of a stage over a whole body, as a step calls them: forces (18a) with D_ab and
/// the step bound, and strain rates (18b-d) with relaxation (14), stress (9) and wave speeds. Which
/// compiled sweeps these are was chosen once; a step knows neither material nor arrangement.

#include "common/parallel/reduction.hpp"
#include "common/scheme/body/material_model.hpp"
#include "common/scheme/body/relaxation.hpp"
#include "common/scheme/sweeps/face_correction.hpp"
#include "common/scheme/sweeps/momentum.hpp"
#include "common/scheme/sweeps/strain_rates.hpp"
#include "common/scheme/time_step.hpp"

#include <memory>
#include <vector>

namespace diptych::scheme {

/// What a scene asks of its sweeps.
struct SweepOptions {
  DissipationKind dissipation;
  double dissipation_factor = 1;
  double face_correction = 0;  ///< kappa_f (notes 3.8), 0: none
  TimeStepRule time_step;
};

/// What the last sweeps summed up.
struct SweepResults {
  double stable_dt = 0;            ///< s, of the last sum_forces with_step
  double numerical_power = 0;      ///< W, of the last sum_forces
  double viscous_dissipation = 0;  ///< J, of the step that the last strain_rates ended, 0: of none
  /// Of the last strain_rates; NaN where a node has not J > 0 and finite dF/dt.
  double least_J = 0;
};

/// What sums over pairs follow strain rates before anything else changes the body.
enum class Following {
  nothing,
  forces,
  forces_and_step,  ///< with the stable step
};

template <int Dim>
class Sweeps {
 public:
  /// @param geometric_rate  of the graph: scheme::geometric_rate
  Sweeps(const Body<Dim>& body,
         std::shared_ptr<const MaterialModel> material,
         const SweepOptions& options,
         double geometric_rate);

  /// Internal forces (18a) with D_ab into body.T; with_step: also the stable step of this state.
  void sum_forces(Body<Dim>& body, bool with_step);

  /// Strain rates (18b-d), relaxation (14), stress (9), wave speeds into the records. F, H, J are
  /// moved by the stage before (SSP), or drift in between (leapfrog). Where it can, it sums the
  /// forces that follow in the same pass; the next sum_forces then adds what is missing.
  void strain_rates(Body<Dim>& body,
                    const Relaxation& relaxation,
                    const StageCombination* stage,
                    double drift,
                    Following following = Following::nothing);

  double stable_dt() const { return results_.stable_dt; }
  double numerical_power() const { return results_.numerical_power; }
  double viscous_dissipation() const { return results_.viscous_dissipation; }
  double least_J() const { return results_.least_J; }
  std::int64_t limited_pairs() const;  ///< whose jump the limiter changed in the last sum_forces
  /// W, of the D_ab of the sum_forces before the last strain_rates with drift, with the velocities
  /// of that drift.  @param loads  power of the loads in T with them  [W]
  double old_numerical_power(const Body<Dim>& body, double loads) const;

  /// Of a state that has been put back or loaded with its forces: what those of volumes and edges
  /// were, of which the next step takes the power.
  void remember_forces(Body<Dim>& body) const;

  /// To go back to a state whose sweeps are not to be made again.
  const SweepResults& results() const { return results_; }
  void set_results(const SweepResults& results);

  const MaterialModel& material() const { return *material_; }
  const TimeStepRule& time_step() const { return options_.time_step; }
  double geometric_rate() const { return geometric_rate_; }  ///< 1/m
  /// Of the undeformed, virgin body, whatever the state is  [s]
  double undeformed_step() const {
    return options_.time_step.limit() / (geometric_rate_ * undeformed_speed_);
  }

 private:
  double largest_rate(const Body<Dim>& body) const;
  void sum_of_forces(parallel::Reduction& reduction);
  void sum_of_strain_rates(parallel::Reduction& reduction, bool with_old_power);
  bool is_one_pass(const Body<Dim>& body) const;
  bool wants_bound(bool with_step) const {
    return with_step && options_.time_step.speeds == Speeds::exact;
  }
  MomentumSweep<Dim> momentum_sweep(Body<Dim>& body, bool with_bound);
  void sum_stage(Body<Dim>& body, bool with_bound, const MakeRecords& make_records);

  std::shared_ptr<const MaterialModel> material_;
  SweepOptions options_;
  MomentumFunction<Dim> momentum_;
  MomentumFunction<Dim> moments_ = nullptr;  // where the reconstruction is symmetric
  StrainRateFunction<Dim> strain_rates_;
  FaceCorrectionSweeps<Dim> face_;
  double geometric_rate_;
  double undeformed_speed_;
  SweepResults results_;
  double old_power_ = 0;  ///< W, of the D_ab of the sum_forces before, with the drift's velocities
  double limited_pairs_ = 0;
  Following made_ = Following::nothing;  ///< by the last strain_rates, which sum_forces is to use
  double old_hourglass_power_ = 0;  ///< W, leapfrog: as old_power_, of what holds unseen motions
  /// What the sweeps find, [chunk]  [J, W, -, W, 1/s, -]
  struct OfChunks {
    std::vector<double> viscous_dissipation, old_power, least_J, numerical_power, largest_rate,
        limited_pairs;
  };
  OfChunks of_chunks_;
};

extern template class Sweeps<2>;
extern template class Sweeps<3>;

}  // namespace diptych::scheme
