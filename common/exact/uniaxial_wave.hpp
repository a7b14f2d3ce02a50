#pragma once
/// Exact finite-strain impact and pull in uniaxial strain (notes 7): the half space x >= 0
/// of the elastic Mooney-Rivlin solid moves at velocity v along x and its face x = 0 is held from
/// t = 0 on. With P(f) = b (f - 1/f) + lambda_hat (f - 1), b = mu (1 + zeta_ratio), P' > 0, P'' <
/// 0:
///
///     v < 0, impact: a shock,  rho v^2 = P(f) (f - 1),  at X = U t, U = -v/(1 - f)
///     v > 0, pull:   a fan,    v = int_1^f c df,  c = sqrt(P'/rho), between X = c(f) t and c(1) t
///
/// Displacement u = X (f - 1) + t v(X/t), since the motion is self-similar.
/// Test: tests/common/exact/uniaxial_wave_test.cpp.

#include "common/functions/expressions.hpp"

#include <string>
#include <vector>

namespace diptych::exact {

using algebra::Vec3;

struct UniaxialWaveParameters {
  double density = 1;        ///< kg/m^3, > 0
  double shear_modulus = 1;  ///< Pa, mu > 0
  double lame = 1;           ///< Pa, lambda > 2 zeta_ratio mu
  double zeta_ratio = 0;     ///< zeta / (xi + zeta)
  double velocity = 0;       ///< m/s, not 0
};

/// Names NAME (u), NAME_v, NAME_f, NAME_P; constants NAME_f_wall, NAME_P_wall and NAME_speed, of
/// the shock or of the head of the fan.
class UniaxialWave : public functions::TimeFunction {
 public:
  /// @throws base::InputError on a pull so fast that no stretch stops it
  UniaxialWave(std::string name, const UniaxialWaveParameters& parameters);

  std::vector<std::string> names() const override;
  std::vector<double> values(double t) const override { return values_at(Vec3::Zero(), t); }
  bool depends_on_position() const override { return true; }
  std::vector<double> values_at(const Vec3& X, double t) const override;

  double stress(double f) const;  ///< P(f)  [Pa]
  double speed(double f) const;   ///< c(f), reference  [m/s]
  double wall_stretch() const { return f_wall_; }
  double front_speed() const { return front_speed_; }  ///< m/s

 private:
  double velocity_of_stretch(double f) const;  // int_1^f c df
  double stretch_of_speed(double c) const;     // inverse of speed()
  std::string name_;
  double rho_, b_, lambda_hat_, velocity_;
  double f_wall_ = 1, front_speed_ = 0;
};

}  // namespace diptych::exact
