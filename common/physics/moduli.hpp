#pragma once
/// Elastic constants and the parameters of the Mooney-Rivlin model that follow from them.

namespace diptych::physics {

/// mu = E / (2 (1 + nu)), lambda = E nu / ((1 + nu)(1 - 2 nu))  [Pa]
struct LameConstants {
  double mu = 0;
  double lambda = 0;
};
LameConstants lame_from_young(double youngs_modulus, double poissons_ratio);

/// xi + zeta = mu/2, lambda_hat = lambda - 4 zeta, zeta = ratio (xi + zeta).
struct MooneyRivlinParameters {
  double xi = 0, zeta = 0, lambda_hat = 0;
};

/// lambda_hat = lambda - 4 zeta  [Pa]
double lambda_hat_of(const LameConstants& lame, double zeta_ratio);

/// Whether the energy (4) is polyconvex: lambda_hat > 0, beyond rounding.
bool is_polyconvex(const LameConstants& lame, double zeta_ratio);

/// @throws base::InputError where mu <= 0, the ratio leaves [0, 1), or lambda_hat <= 0 (the energy
///         would not be polyconvex); names the largest admissible ratio
MooneyRivlinParameters mooney_rivlin_parameters(const LameConstants& lame, double zeta_ratio);

}  // namespace diptych::physics
