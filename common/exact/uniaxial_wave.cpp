#include "common/exact/uniaxial_wave.hpp"

#include "common/base/error.hpp"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace diptych::exact {

namespace {

/// Root of a monotone function between two points, by bisection: 200 halvings reach rounding.
template <class Function>
double root_between(const Function& g, double left, double right) {
  const bool rises = g(right) > 0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (left + right);
    ((g(middle) > 0) == rises ? right : left) = middle;
  }
  return 0.5 * (left + right);
}

}  // namespace

UniaxialWave::UniaxialWave(std::string name, const UniaxialWaveParameters& p)
    : name_(std::move(name)),
      rho_(p.density),
      b_(p.shear_modulus * (1 + p.zeta_ratio)),
      lambda_hat_(p.lame - 2 * p.zeta_ratio * p.shear_modulus),
      velocity_(p.velocity) {
  if (!(lambda_hat_ > 0) || velocity_ == 0) {
    throw base::InputError(fmt::format(
        "functions.{}: needs lambda_hat = lame - 2 zeta_ratio shear_modulus > 0 (it is {:.6g} Pa) "
        "and a velocity that is not 0",
        name_, lambda_hat_));
  }
  if (velocity_ < 0) {
    const auto excess = [&](double f) {
      return stress(f) * (f - 1) - rho_ * velocity_ * velocity_;
    };
    double least = 0.5;
    while (excess(least) < 0)
      least *= 0.5;
    f_wall_ = root_between(excess, least, 1);
    front_speed_ = -velocity_ / (1 - f_wall_);
  } else {
    const auto excess = [&](double f) { return velocity_of_stretch(f) - velocity_; };
    double most = 2;
    while (excess(most) < 0)
      most *= 2;
    f_wall_ = root_between(excess, 1, most);
    front_speed_ = speed(1);
  }
}

double UniaxialWave::stress(double f) const {
  return b_ * (f - 1 / f) + lambda_hat_ * (f - 1);
}

double UniaxialWave::speed(double f) const {
  return std::sqrt((b_ * (1 + 1 / (f * f)) + lambda_hat_) / rho_);
}

double UniaxialWave::velocity_of_stretch(double f) const {
  // int sqrt(a + b/f^2) df = r - sqrt(b) atanh(sqrt(b)/r), r = sqrt(a f^2 + b)
  const double a = b_ + lambda_hat_, root_b = std::sqrt(b_);
  const auto antiderivative = [&](double g) {
    const double r = std::sqrt(a * g * g + b_);
    return r - root_b * std::log((r + root_b) / (std::sqrt(a) * g));
  };
  return (antiderivative(f) - antiderivative(1)) / std::sqrt(rho_);
}

double UniaxialWave::stretch_of_speed(double c) const {
  return std::sqrt(b_ / (rho_ * c * c - lambda_hat_ - b_));
}

std::vector<std::string> UniaxialWave::names() const {
  return {name_,           name_ + "_v",      name_ + "_f",
          name_ + "_P",    name_ + "_f_wall", name_ + "_P_wall",
          name_ + "_speed"};
}

std::vector<double> UniaxialWave::values_at(const Vec3& X, double t) const {
  double f = 1, v = velocity_;
  if (X[0] < front_speed_ * t) {
    if (velocity_ < 0 || X[0] <= speed(f_wall_) * t) {
      f = f_wall_;
      v = 0;
    } else {
      f = stretch_of_speed(X[0] / t);
      v = velocity_ - velocity_of_stretch(f);
    }
  }
  return {X[0] * (f - 1) + t * v, v, f, stress(f), f_wall_, stress(f_wall_), front_speed_};
}

}  // namespace diptych::exact
