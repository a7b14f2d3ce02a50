#pragma once
/// Functions of time for cases with a known answer. ZenerMode: the amplitude q(t) of one standing
/// mode of the linear generalised Zener solid (notes 1.4), which shear waves of any size and
/// small waves of every kind follow:
///
///     rho q'' + k2 [M q + sum_a M_a (q - q_a)] = 0,    q_a' = (q - q_a) / tau_a
///
/// Test: tests/common/functions/time_functions_test.cpp.

#include "common/functions/expressions.hpp"

#include <complex>
#include <string>
#include <vector>

namespace diptych::functions {

struct ZenerModeParameters {
  double wave_number_squared = 1;     ///< k2, 1/m^2, > 0
  double density = 1;                 ///< rho, kg/m^3, > 0
  double modulus = 1;                 ///< M at equilibrium, Pa, > 0
  std::vector<double> branch_moduli;  ///< M_a, Pa, > 0
  std::vector<double> branch_times;   ///< tau_a, s, > 0; as many
  double amplitude = 0;               ///< q(0)
  double rate = 0;                    ///< q'(0)
  bool relaxed = false;               ///< q_a(0) = q(0) at equilibrium, else 0 (virgin branches)
};

/// Names NAME, NAME_dot, NAME_ddot, and NAME_1 ... NAME_n for q_1 ... q_n.
class ZenerMode : public TimeFunction {
 public:
  /// @throws base::InputError where two eigenvalues coincide (critical damping), so that no sum of
  ///         exponentials is the answer
  /// @pre    the ranges above
  ZenerMode(std::string name, const ZenerModeParameters& parameters);

  std::vector<std::string> names() const override;
  std::vector<double> values(double t) const override;

  /// Exponents of the modes, 1/s.
  const std::vector<std::complex<double>>& roots() const { return roots_; }

 private:
  std::string name_;
  ZenerModeParameters parameters_;
  std::vector<double> times_;                        // s, the distinct ones among branch_times
  std::vector<size_t> time_of_;                      // [n_branches] into times_
  std::vector<std::complex<double>> roots_;          // [2 + n_times] 1/s
  std::vector<std::complex<double>> weight_;         // [2 + n_times] of exp(root t) in q
  std::vector<std::complex<double>> branch_weight_;  // [n_times][2 + n_times] in q_a, row-major
};

}  // namespace diptych::functions
