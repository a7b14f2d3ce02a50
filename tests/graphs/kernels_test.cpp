#include "common/base/error.hpp"
#include "sph/kernels/kernel.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace diptych::sph {
namespace {

/// int W dV by Simpson's rule on [0, support h]; the kernels are piecewise polynomials of degree
/// 7 with breaks at multiples of h, so 600 intervals leave an error below 1e-9.
double integral(const Kernel& kernel, double h, int dimension) {
  const int n = 600;
  const double dr = kernel.support * h / n;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double r = i * dr, weight = i == 0 || i == n ? 1 : (i % 2 == 1 ? 4 : 2);
    const double shell = dimension == 2 ? 2 * std::numbers::pi * r : 4 * std::numbers::pi * r * r;
    sum += weight * shell * kernel.value(r, h, dimension);
  }
  return sum * dr / 3;
}

TEST(Kernels, AreNormalisedInThePlaneAndInSpace) {
  const base::Registry<Kernel> menu = kernels();
  for (const std::string& name : menu.names()) {
    for (int dimension : {2, 3}) {
      EXPECT_NEAR(integral(menu.at(name), 0.7, dimension), 1, 1e-8) << name;
    }
  }
}

TEST(Kernels, HaveTheSlopeOfTheirValue) {
  const base::Registry<Kernel> menu = kernels();
  for (const std::string& name : menu.names()) {
    const Kernel kernel = menu.at(name);
    for (int dimension : {2, 3}) {
      for (double r = 0.05; r < 1.3 * kernel.support; r += 0.0973) {
        const double e = 1e-5, h = 1.3;
        const double difference =
            (kernel.value(r + e, h, dimension) - kernel.value(r - e, h, dimension)) / (2 * e);
        // central differences of piecewise C^1 slopes: e W'' jumps
        EXPECT_NEAR(kernel.slope(r, h, dimension), difference, 2e-5 * kernel.sigma(dimension))
            << name << " at " << r;
      }
    }
  }
}

TEST(Kernels, VanishOutsideTheirSupportAndNotInside) {
  const base::Registry<Kernel> menu = kernels();
  for (const std::string& name : menu.names()) {
    const Kernel kernel = menu.at(name);
    EXPECT_EQ(kernel.f(kernel.support), 0);
    EXPECT_EQ(kernel.f_slope(kernel.support + 1), 0);
    EXPECT_GT(kernel.f(0.99 * kernel.support), 0);
    EXPECT_LT(kernel.f_slope(0.99 * kernel.support), 0);
    EXPECT_EQ(kernel.f_slope(0), 0);
  }
}

TEST(Kernels, AnswerAWrongNameWithTheNearest) {
  try {
    kernels().at("cubic_spline");
    FAIL() << "an unknown kernel was found";
  } catch (const base::InputError& error) {
    EXPECT_STREQ(error.what(), "unknown kernel 'cubic_spline'; did you mean 'cubic-spline'?");
  }
}

}  // namespace
}  // namespace diptych::sph
