/// Elastic constants, Mooney-Rivlin parameters, linearised wave speeds, and the glassy and
/// equilibrium moduli of the linear limit against tabulated values.

#include "common/physics/moduli.hpp"

#include "common/base/error.hpp"
#include "tests/common/physics/body.hpp"
#include "tests/common/physics/reference_tables.hpp"

#include <gtest/gtest.h>

#include <string>

namespace diptych::tests {
namespace {

using physics::lame_from_young;
using physics::LameConstants;
using physics::mooney_rivlin_parameters;

/// Parameters of E = 17 MPa with the given Poisson's ratio and split, and branches xi^a = beta_C
/// xi, zeta^a = beta_G zeta.
Body<physics::MooneyRivlin> rubber(double nu, double zeta_ratio, double beta_C, double beta_G) {
  const auto p = mooney_rivlin_parameters(lame_from_young(17e6, nu), zeta_ratio);
  Body<physics::MooneyRivlin> body;
  body.material = {p.xi, p.zeta, p.lambda_hat};
  body.branches = {{beta_C * p.xi, 1, beta_G * p.zeta, 1}};
  body.states = {virgin()};
  return body;
}

struct LinearModuli {
  double M, mu;
};
/// P-wave modulus and shear modulus of the response in the reference state, in an oblique
/// direction.
LinearModuli linear_moduli(const Body<physics::MooneyRivlin>& body) {
  const auto X = physics::deformation_of(algebra::identity<double>());
  const Vector<double> N = {{0.48, 0.6, 0.64}};
  const auto c = physics::wave_speeds(body.response(X), X, 1, N);
  EXPECT_NEAR(c.c_s1 / c.c_s2, 1, 1e-12);  // isotropic
  return {c.c_p * c.c_p, c.c_s1 * c.c_s1};
}

TEST(Moduli, LameConstantsOfThePublishedMaterials) {
  // to the seven or eight digits of the catalogue
  EXPECT_NEAR(lame_from_young(17e6, 0.45).lambda, 52.758621e6, 1);
  EXPECT_NEAR(lame_from_young(17e6, 0.45).mu, 5.862069e6, 1);
  EXPECT_NEAR(lame_from_young(17e6, 0.3).lambda, 9.807692e6, 1);
  EXPECT_NEAR(lame_from_young(17e6, 0.3).mu, 6.538462e6, 1);
}

TEST(Moduli, SplitsOfTheViscoelasticMaterials) {
  struct Row {
    double nu, zeta_ratio, xi, zeta, lambda_hat;
  };
  for (const Row row : {Row{0.3, 0, 3.2692308e6, 0, 9.8076923e6},                  // VE1
                        Row{0.3, 0.5, 1.6346154e6, 1.6346154e6, 3.2692308e6},      // VE2
                        Row{0.45, 0.5, 1.4655172e6, 1.4655172e6, 46.896552e6}}) {  // VE5
    const auto p = mooney_rivlin_parameters(lame_from_young(17e6, row.nu), row.zeta_ratio);
    EXPECT_NEAR(p.xi, row.xi, 0.1);
    EXPECT_NEAR(p.zeta, row.zeta, 0.1);
    EXPECT_NEAR(p.lambda_hat, row.lambda_hat, 1);
  }
}

TEST(Moduli, LinearisedSpeedsDoNotDependOnTheSplit) {
  for (const double zeta_ratio : {0.0, 0.25, 0.5}) {
    const auto soft = linear_moduli(rubber(0.3, zeta_ratio, 0, 0));
    EXPECT_NEAR(std::sqrt(soft.M / 1100), 144.2366, 1e-4);
    EXPECT_NEAR(std::sqrt(soft.mu / 1100), 77.0977, 1e-4);
    const auto stiff = linear_moduli(rubber(0.45, zeta_ratio, 0, 0));
    EXPECT_NEAR(std::sqrt(stiff.M / 1100), 242.117, 1e-3);
    EXPECT_NEAR(std::sqrt(stiff.mu / 1100), 73.00, 1e-2);
  }
}

TEST(Moduli, GlassyAndEquilibriumModuliAgreeWithTheReferenceTable) {
  const auto table = reference_table("ref2_moduli.json");
  const auto relaxed = linear_moduli(rubber(0.3, 0.5, 0, 0));
  const auto glassy = linear_moduli(rubber(0.3, 0.5, 1, 1));
  const auto agree = [&](const char* name, double equilibrium, double instantaneous) {
    const double expected = table.at(name).at("equilibrium");
    const double expected_glassy = table.at(name).at("glassy");
    const double branch = table.at(name).at("branches").at(0).at(0);
    EXPECT_NEAR(equilibrium / expected, 1, 1e-12) << name;
    EXPECT_NEAR(instantaneous / expected_glassy, 1, 1e-12) << name;
    EXPECT_NEAR((instantaneous - equilibrium) / branch, 1, 1e-12) << name;
  };
  agree("P", relaxed.M, glassy.M);
  agree("S", relaxed.mu, glassy.mu);
  agree("lam", relaxed.M - 2 * relaxed.mu, glassy.M - 2 * glassy.mu);
  agree("K", relaxed.M - 4. / 3 * relaxed.mu, glassy.M - 4. / 3 * glassy.mu);
  for (const char* wave : {"P", "S"}) {
    const double slow = table.at("speeds").at(wave).at("equilibrium");
    const double fast = table.at("speeds").at(wave).at("glassy");
    const bool pressure = wave[0] == 'P';
    EXPECT_NEAR(std::sqrt((pressure ? relaxed.M : relaxed.mu) / 1100) / slow, 1, 1e-12);
    EXPECT_NEAR(std::sqrt((pressure ? glassy.M : glassy.mu) / 1100) / fast, 1, 1e-12);
  }
}

TEST(Moduli, IsochoricMaterialsHaveTheSameLinearLimit) {
  const auto lame = lame_from_young(17e6, 0.3);
  physics::IsochoricNeoHookean linear;
  linear.mu = lame.mu, linear.kappa = lame.lambda + 2 * lame.mu / 3;
  physics::IsochoricNeoHookeanJ2 squared;
  squared.mu = linear.mu, squared.kappa = linear.kappa;
  const auto X = physics::deformation_of(algebra::identity<double>());
  const Vector<double> N = {{0.48, 0.6, 0.64}};
  for (const auto& r : {linear.response(X), squared.response(X)}) {
    const auto c = physics::wave_speeds(r, X, 1100, N);
    EXPECT_NEAR(c.c_p, 144.2366, 1e-4);
    EXPECT_NEAR(c.c_s1, 77.0977, 1e-4);
    EXPECT_NEAR(c.c_s2, 77.0977, 1e-4);
  }
}

std::string refusal(const LameConstants& lame, double zeta_ratio) {
  try {
    mooney_rivlin_parameters(lame, zeta_ratio);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Moduli, RefuseASplitThatIsNotPolyconvexAndNameTheLargest) {
  // nu = 0.2: lambda/(2 mu) = nu/(1 - 2 nu) = 1/3
  const auto lame = lame_from_young(17e6, 0.2);
  EXPECT_NE(refusal(lame, 0.5).find("use a zeta_ratio below 0.3333"), std::string::npos);
  EXPECT_EQ(refusal(lame, 0.3333), "accepted");
  EXPECT_NE(refusal(lame, 0.3334), "accepted");
  // nu <= 0: no ratio helps
  EXPECT_NE(refusal(lame_from_young(17e6, 0), 0).find("larger Poisson's ratio"), std::string::npos);
}

TEST(Moduli, RefuseNegativeModuliRatiosOutOfRangeAndNotANumber) {
  EXPECT_NE(refusal({-1, 1}, 0).find("mu = -1 Pa must be positive"), std::string::npos);
  EXPECT_NE(refusal({std::nan(""), 1}, 0), "accepted");
  EXPECT_NE(refusal({1, std::nan("")}, 0), "accepted");
  for (const double ratio : {-0.1, 1.0, 2.0, std::nan("")})
    EXPECT_NE(refusal({1, 100}, ratio).find("must lie in [0, 1)"), std::string::npos) << ratio;
}

}  // namespace
}  // namespace diptych::tests
