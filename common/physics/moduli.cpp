#include "common/physics/moduli.hpp"

#include "common/base/error.hpp"

#include <fmt/format.h>

namespace diptych::physics {

LameConstants lame_from_young(double youngs_modulus, double poissons_ratio) {
  const double nu = poissons_ratio;
  return {youngs_modulus / (2 * (1 + nu)), youngs_modulus * nu / ((1 + nu) * (1 - 2 * nu))};
}

double lambda_hat_of(const LameConstants& lame, double zeta_ratio) {
  return lame.lambda - 2 * zeta_ratio * lame.mu;
}

bool is_polyconvex(const LameConstants& lame, double zeta_ratio) {
  return lame.lambda > 0 && lambda_hat_of(lame, zeta_ratio) > 1e-12 * lame.lambda;
}

MooneyRivlinParameters mooney_rivlin_parameters(const LameConstants& lame, double zeta_ratio) {
  if (!(lame.mu > 0)) {
    throw base::InputError(fmt::format("shear modulus mu = {:g} Pa must be positive", lame.mu));
  }
  if (!(zeta_ratio >= 0 && zeta_ratio < 1)) {
    throw base::InputError(fmt::format("zeta_ratio = {:g} must lie in [0, 1)", zeta_ratio));
  }
  MooneyRivlinParameters p;
  p.zeta = zeta_ratio * lame.mu / 2;
  p.xi = lame.mu / 2 - p.zeta;
  p.lambda_hat = lambda_hat_of(lame, zeta_ratio);
  if (!is_polyconvex(lame, zeta_ratio)) {
    const double largest = lame.lambda / (2 * lame.mu);
    throw base::InputError(fmt::format(
        "zeta_ratio = {:g} gives lambda_hat = lambda - 4 zeta = {:g} Pa, which must be positive "
        "(polyconvexity, eq. 4); {}",
        zeta_ratio, p.lambda_hat,
        largest > 0 ? fmt::format("use a zeta_ratio below {:.4g}", largest)
                    : std::string("use a larger Poisson's ratio")));
  }
  return p;
}

}  // namespace diptych::physics
