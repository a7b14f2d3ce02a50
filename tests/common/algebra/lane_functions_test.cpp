/// Against long double of the standard library: the error in units in the last place.

#include "common/algebra/lane_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace diptych::algebra {
namespace {

// Of the program's own instruction set: compiled as the callers are.
DIPTYCH_CLONES void sines(const double* x, double* sine, double* cosine) {
  Lanes s, c;
  sine_cosine(load(x), s, c);
  store(sine, s);
  store(cosine, c);
}
DIPTYCH_CLONES void exponentials(const double* x, double* result) {
  store(result, exponential(load(x)));
}

double units_in_last_place(double value, long double exact) {
  const double nearest = std::fabs(static_cast<double>(exact));
  const double unit = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact) / unit);
}

TEST(LaneFunctions, SineAndCosineAreWithinTwoUnitsInTheLastPlace) {
  std::mt19937_64 random(7);
  for (const double size : {1e-8, 0.1, 3.0, 100.0, 7.9e5, 1e9}) {
    std::uniform_real_distribution<double> draw(-size, size);
    for (int round = 0; round < 2000; ++round) {
      double x[n_lanes], s[n_lanes], c[n_lanes];
      for (double& xi : x)
        xi = draw(random);
      if (round % 2 == 1) x[3] = std::round(x[3]) * 1.5707963267948966;  // next to a zero
      sines(x, s, c);
      for (int i = 0; i < n_lanes; ++i) {
        EXPECT_LE(units_in_last_place(s[i], std::sin(static_cast<long double>(x[i]))), 2) << x[i];
        EXPECT_LE(units_in_last_place(c[i], std::cos(static_cast<long double>(x[i]))), 2) << x[i];
      }
    }
  }
}

TEST(LaneFunctions, ExponentialIsWithinTwoUnitsInTheLastPlace) {
  std::mt19937_64 random(8);
  for (const double size : {1e-9, 0.3, 5.0, 700.0}) {
    std::uniform_real_distribution<double> draw(-size, size);
    for (int round = 0; round < 2000; ++round) {
      double x[n_lanes], e[n_lanes];
      for (double& xi : x)
        xi = draw(random);
      exponentials(x, e);
      for (int i = 0; i < n_lanes; ++i)
        EXPECT_LE(units_in_last_place(e[i], std::exp(static_cast<long double>(x[i]))), 2) << x[i];
    }
  }
}

TEST(LaneFunctions, HaveTheValuesOfTheLimits) {
  const double infinity = std::numeric_limits<double>::infinity(), none = std::nan("");
  const double x[n_lanes] = {0, -0.0, 710, infinity, -746, -infinity, none, -720};
  double e[n_lanes], s[n_lanes], c[n_lanes];
  exponentials(x, e);
  EXPECT_EQ(e[0], 1);
  EXPECT_EQ(e[1], 1);
  EXPECT_EQ(e[2], infinity);
  EXPECT_EQ(e[3], infinity);
  EXPECT_EQ(e[4], 0);
  EXPECT_EQ(e[5], 0);
  EXPECT_TRUE(std::isnan(e[6]));
  EXPECT_NEAR(e[7] / std::exp(-720), 1, 1e-10) << "subnormal";
  sines(x, s, c);
  EXPECT_EQ(s[0], 0);
  EXPECT_EQ(c[0], 1);
  EXPECT_TRUE(std::isnan(s[3]) && std::isnan(c[5]) && std::isnan(s[6]));
  EXPECT_EQ(s[2], std::sin(710.0)) << "a neighbour that is no number does not matter";
}

TEST(LaneFunctions, ALaneDoesNotFeelItsNeighbours) {
  double x[n_lanes] = {1, 2, 3, 4, 5, 6, 7, 8}, s[n_lanes], c[n_lanes], far_s[n_lanes],
         far_c[n_lanes];
  sines(x, s, c);
  x[5] = 1e12;
  sines(x, far_s, far_c);
  for (const int i : {0, 1, 2, 3, 4, 6, 7}) {
    EXPECT_EQ(s[i], far_s[i]);
    EXPECT_EQ(c[i], far_c[i]);
  }
}

}  // namespace
}  // namespace diptych::algebra
