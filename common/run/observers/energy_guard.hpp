#pragma once
/// Stops a run whose energy budget does not close, or whose numerical dissipation gives energy in
/// place of taking it: an unstable run makes energy of nothing long before a J or a value shows it.
/// Stops one, too, whose numerical dissipation and walls have taken most of the energy: what is
/// left is no solution. Test: tests/common/run/guards_test.cpp

#include "common/run/energy_record.hpp"
#include "common/run/observers/observer.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace diptych::run {

/// Of what numerical dissipation takes, and walls from nodes that they catch. What a body holds at
/// first may be a trace of motion, which no mesh resolves, beside what its loads bring later: it is
/// not judged before `from`.
struct LossBound {
  double largest = 0;  ///< share of the largest energy so far; infinite: any
  double from = 0;     ///< s
  /// From here on whatever the time is, since a limit of steps may end the run.
  std::int64_t from_step = std::numeric_limits<std::int64_t>::max();
};

class EnergyGuard : public Observer {
 public:
  /// @param initial       of the body at t = 0
  /// @param threshold     largest admissible |residual|, and dissipation below zero, as a share of
  ///                      the largest energy so far
  /// @param loss          largest admissible numerical dissipation, the same
  /// @param units         a body that holds no more than rounding makes is at rest, and as much of
  ///                      any residual is not judged
  EnergyGuard(const scheme::Balance& initial,
              double threshold,
              const LossBound& loss,
              const EnergyUnits& units)
      : energy_(initial, units), threshold_(threshold), loss_(loss) {}

  /// A residual that is not finite is refused at once. Others are not judged while the body is at
  /// rest, and have a bound of their own in the first steps after it: see steps_of_start. Losses
  /// are not judged while it stands still: see steps_of_any_loss.
  /// @throws base::BreakdownError
  void at_check(const Check& check) override;
  /// A body at rest stays so for as long as no J of a node moves: between two checks a load may set
  /// in. Shear moves none; after many steps of it the first residual has the bound
  /// most_of_growth.
  void after_step(const StepReport& step) override;
  void at_output(const Output& output) override {
    at_check({output.step, output.balance, output.audit});
  }

  void archive(algebra::Archive& archive) override {
    energy_.archive("energy guard", archive);
    archive.integer("energy guard/at rest until step", at_rest_until_);
    archive.integer("energy guard/still until step", still_until_);
    archive.integer("energy guard/at rest", is_at_rest_);
    archive.integer("energy guard/checked at step", checked_at_);
    archive.integer("energy guard/still", is_still_);
    archive.real("energy guard/doubled energy", "J", doubled_);
    archive.integers("energy guard/doubled at step", doubled_at_);
  }

  /// A load on a body at rest brings, in its first steps, less energy than a step errs by. Beyond
  /// what rounding makes, shipped cases have residuals of up to 0.44 after two steps, 0.08 after
  /// five and 0.02 after ten: a quarter of the first bound after n steps. A traction that sets in
  /// at once brings energy at a constant rate, and what the first steps erred by falls with 1/n
  /// only: 0.2/n to 0.32/n in strips and bars of 20 to 80 elements with SSP-RK2 and SSP-RK3.
  static constexpr std::int64_t steps_of_start = 50;
  static double bound_of_start(std::int64_t n) {
    const auto real_n = static_cast<double>(n);
    return std::max(8 / (real_n * real_n), 0.5 / real_n);
  }
  /// A pulse begins in the midst of a run: so do steps count from the check at which the energy
  /// passed a 64th to a 128th of what it is, with a bound of no more than this: what is unstable
  /// makes all of what it grows by of nothing, and a residual that stays is judged later as any.
  static constexpr size_t n_doublings = 7;
  static constexpr double most_of_growth = 0.5;
  /// What leapfrog's energy swings by to the side of the residual is left out, up to as many times
  /// the threshold: it comes back. A body that vibrates under a load it hardly holds has that for
  /// many steps.
  static constexpr double most_of_swing = 10;
  /// Steps from a standstill in which losses are not judged, and what a body stands still with, as
  /// a share of what rounding makes of strain energies: strains of 1e-12.
  static constexpr std::int64_t steps_of_any_loss = 20;
  static constexpr double noise = 1e-10;

 private:
  /// Notes where the largest energy so far has doubled.
  void note_growth(double scale, std::int64_t step);
  /// Of the residual, at a step.
  double bound_at(std::int64_t step) const;
  /// @throws base::BreakdownError
  void refuse_gain(const Check& check, double gained) const;
  void refuse_loss(const Check& check) const;
  double scale_of_loss() const;
  void judge_loss(const Check& check);
  void refuse_residual(const Check& check, double residual, double bound) const;

  EnergyRecord energy_;
  double threshold_;
  LossBound loss_;
  std::int64_t at_rest_until_ = -steps_of_start;  // step
  bool is_at_rest_ = false;                       // since the last check
  std::int64_t checked_at_ = 0;                   // step of the last check
  std::int64_t still_until_ = -steps_of_start;    // step
  bool is_still_ = false;                         // since the last check
  double doubled_ = 0;                            // J, the energy when it had last doubled
  std::vector<std::int64_t> doubled_at_;          // steps of the last n_doublings doublings
};

}  // namespace diptych::run
