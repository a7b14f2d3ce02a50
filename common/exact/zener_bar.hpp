#pragma once
/// Waves of small amplitude along x in a bar of the linear generalised Zener solid (notes 1.4) that
/// starts at rest with virgin branches:
///
///     rho u_tt = sigma_x,   sigma_bar = M(s) u_x_bar,   M(s) = M + sum_a M_a s tau_a/(1 + s tau_a)
///
/// either 0 <= x <= L, fixed at x = 0 and loaded by the stress sigma(t) at x = L (slab), or
/// x >= 0, driven by the velocity v(t) at x = 0 (wave). With k = s sqrt(rho/M(s)) the transform is
/// a sum of terms B(s) e^(-k d), one for each path of length d by which the load comes to x. The
/// front of each, at c = sqrt((M + sum M_a)/rho), is a factor e^(-s d/c) that is taken exactly; the
/// smooth rest is inverted numerically, after the steady answer to an oscillating load has been
/// taken out in closed form. Without branches this is d'Alembert's solution.
/// Test: tests/common/exact/zener_bar_test.cpp.

#include "common/functions/expressions.hpp"

#include <complex>
#include <string>
#include <vector>

namespace diptych::exact {

using algebra::Vec3;

/// sigma(t) or v(t), for t > 0: a sum of A_j exp(p_j t).
enum class Signal {
  step,              ///< amplitude
  one_minus_cosine,  ///< amplitude (1 - cos(omega t))
  sine  ///< amplitude sin(omega t) (1 - exp(-ramp_rate t))^3: four times differentiable
};

struct ZenerBarParameters {
  bool is_slab = true;                ///< slab loaded at x = length, or wave from x = 0
  double length = 1;                  ///< m, > 0, slab only
  double density = 1;                 ///< kg/m^3, > 0
  double modulus = 1;                 ///< M at equilibrium, Pa, > 0
  std::vector<double> branch_moduli;  ///< M_a, Pa, > 0
  std::vector<double> branch_times;   ///< tau_a, s, > 0; as many
  Signal signal = Signal::step;
  double amplitude = 0;          ///< Pa (slab) or m/s (wave)
  double angular_frequency = 0;  ///< 1/s, > 0 where the signal oscillates
  double ramp_rate = 0;          ///< 1/s, > 0, sine only
};

/// What the bar does at one place and time.
struct BarMotion {
  double u = 0, v = 0, strain = 0, stress = 0;  ///< m, m/s, -, Pa
};

/// Names NAME (u), NAME_v, NAME_strain, NAME_stress; where the signal oscillates also NAME_speed
/// (phase speed, m/s) and NAME_attenuation (Np/m) of the steady wave.
class ZenerBar : public functions::TimeFunction {
 public:
  ZenerBar(std::string name, const ZenerBarParameters& parameters);

  std::vector<std::string> names() const override;
  std::vector<double> values(double t) const override { return values_at(Vec3::Zero(), t); }
  bool depends_on_position() const override { return true; }
  std::vector<double> values_at(const Vec3& X, double t) const override;
  void values_at_all(std::span<const Vec3> X, double t, double* values) const override;

  /// @param Real      arithmetic of the inversion, double or long double
  /// @param n_points  of the contour, an even number; 24 suit double, 32 long double
  template <class Real>
  BarMotion motion(double x, double t, int n_points) const;

  double front_speed() const { return front_speed_; }  ///< m/s
  double phase_speed() const;                          ///< m/s
  double attenuation() const;                          ///< Np/m

 private:
  std::string name_;
  ZenerBarParameters p_;
  double front_speed_;
  struct Term {
    std::complex<double> amplitude, exponent;
  };
  std::vector<Term> signal_;  // sum of amplitude exp(exponent t)
};

}  // namespace diptych::exact
