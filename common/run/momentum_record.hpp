#pragma once
/// The momenta of a run over time: how far they are from what they began with and the impulse of
/// loads and supports since then, relative to what the nodes have held.

#include "common/algebra/archive.hpp"
#include "common/run/energy_units.hpp"
#include "common/scheme/budget/audit.hpp"
#include "common/scheme/budget/balance.hpp"

#include <algorithm>
#include <string>

namespace diptych::run {

class MomentumRecord {
 public:
  explicit MomentumRecord(const scheme::Balance& initial, const MomentumUnits& rounding = {})
      : linear_(initial.linear_momentum), angular_(initial.angular_momentum), rounding_(rounding) {}

  /// What the nodes hold now counts for what drifts are measured with.
  void note_scales(const scheme::Balance& now) {
    linear_scale_ = std::max(linear_scale_, now.momentum_scale);
    angular_scale_ = std::max(angular_scale_, now.angular_scale);
  }

  void at(const scheme::Balance& now, const scheme::Audit& audit) {
    note_scales(now);
    const auto share = [](const algebra::Vec3& drift, double scale, double rounding) {
      return scale > rounding ? drift.norm() / scale : 0;
    };
    linear_drift_ = share(now.linear_momentum - linear_ - audit.impulse.linear, linear_scale_,
                          rounding_.linear);
    angular_drift_ = share(now.angular_momentum - angular_ - audit.impulse.angular, angular_scale_,
                           rounding_.angular);
  }

  /// Of the last call of at(), as a share of the largest sum over the nodes of |p| so far.
  double linear_drift() const { return linear_drift_; }
  /// The same of |x||p|, x from the initial centroid.
  double angular_drift() const { return angular_drift_; }
  /// That sum  [N m s]
  double angular_scale() const { return angular_scale_; }

  /// @param group  of the archive, without "/" at its end
  void archive(const std::string& group, algebra::Archive& archive) {
    archive.vector(group + "/initial linear momentum", "N s", linear_);
    archive.vector(group + "/initial angular momentum", "N m s", angular_);
    archive.real(group + "/momentum scale", "N s", linear_scale_);
    archive.real(group + "/angular scale", "N m s", angular_scale_);
  }

 private:
  algebra::Vec3 linear_, angular_;  ///< N s, N m s, of the start
  MomentumUnits rounding_;
  double linear_scale_ = 0, angular_scale_ = 0;
  double linear_drift_ = 0, angular_drift_ = 0;
};

}  // namespace diptych::run
