#pragma once
/// The prescribed velocities of a step: five instants, a quarter of it apart, and the rates that
/// the polynomial through them has. Test: tests/common/scheme/prescribed_velocity_test.cpp

#include "common/algebra/archive.hpp"
#include "common/algebra/vectors.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace diptych::scheme {

using algebra::Vec3;

class VelocitiesInStep {
 public:
  /// @param prescribed  (t) -> velocities [m/s] of the constrained nodes
  template <class Prescribed>
  void begin_step(double t, double dt, const Prescribed& prescribed) {
    // the velocities of the state, which a jump at this instant must not replace
    const bool goes_on = !at_[4].empty() && std::abs(t - end()) <= 1e-9 * step_;
    begin_ = t;
    step_ = dt;
    if (goes_on) {
      std::swap(at_[0], at_[4]);
    } else {
      at_[0] = prescribed(t);
    }
    for (int k = 1; k <= 4; ++k)
      at_[k] = prescribed(t + 0.25 * k * dt);
  }
  /// At the end of a step, t: goes on with velocities behind a jump there, those of before as those
  /// of the beginning.
  void jump(double t, const std::vector<Vec3>& behind) {
    begin_ = t - step_;
    std::swap(at_[0], at_[4]);
    for (int k = 1; k <= 4; ++k)
      at_[k] = behind;
  }
  /// The same where there are none.
  void begin_step(double t, double dt) {
    begin_ = t;
    step_ = dt;
  }

  double begin() const { return begin_; }
  double step() const { return step_; }  ///< s, 0 before the first
  double end() const { return begin_ + step_; }
  double middle() const { return begin_ + 0.5 * step_; }
  const std::vector<Vec3>& at_begin() const { return at_[0]; }
  const std::vector<Vec3>& at_middle() const { return at_[2]; }
  const std::vector<Vec3>& at_end() const { return at_[4]; }

  /// Of node k at a fraction of the step, by the fourth-order differences of its five values; the
  /// mean over the step where it jumps  [m/s^2]
  Vec3 rate(size_t k, double fraction) const {
    constexpr double first[5] = {-25, 48, -36, 16, -3}, central[5] = {1, -8, 0, 8, -1};
    if (jumps(k)) return (at_[4][k] - at_[0][k]) / step_;
    Vec3 sum = Vec3::Zero();
    for (size_t i = 0; i < 5; ++i) {
      const double weight = fraction == 0 ? first[i] : fraction == 1 ? -first[4 - i] : central[i];
      sum += weight * at_[i][k];
    }
    return sum / (3 * step_);
  }

  /// Whether the velocity of node k jumps or bends within the step, so that a polynomial through
  /// its five values would swing far beyond them: their fourth difference is that of a jump.
  bool jumps(size_t k) const {
    constexpr double fourth_difference[5] = {1, -4, 6, -4, 1};
    Vec3 difference = Vec3::Zero();
    double variation = 0;
    for (size_t i = 0; i < 5; ++i) {
      difference += fourth_difference[i] * at_[i][k];
      if (i > 0) variation += (at_[i][k] - at_[i - 1][k]).norm();
    }
    return difference.norm() > 0.5 * variation;
  }

  /// What |v|^2 of node k has grown by, whatever it did in between  [m^2/s^2]
  double growth_of_square(size_t k) const {
    return at_[4][k].squaredNorm() - at_[0][k].squaredNorm();
  }

  void archive(algebra::Archive& archive) {
    archive.real("boundary/step begin", "s", begin_);
    archive.real("boundary/step", "s", step_);
    for (size_t k = 0; k < at_.size(); ++k)
      archive.vectors(fmt::format("boundary/prescribed {} of 4", k), "m/s", at_[k]);
  }

 private:
  double begin_ = 0, step_ = 0;          ///< s
  std::array<std::vector<Vec3>, 5> at_;  ///< [constrained nodes] m/s each
};

}  // namespace diptych::scheme
