/// Stress measures against values worked out by hand.

#include "common/cases/stress_measures.hpp"

#include <gtest/gtest.h>

namespace diptych::cases {
namespace {

using algebra::Mat3;

TEST(StressMeasures, CauchyStressOfAUniaxialStretchIsForceOverDeformedArea) {
  // 12 Pa on the undeformed area, which the stretch leaves 0.5 x 0.5 of: 48 Pa
  const Mat3 F = Eigen::Vector3d(2, 0.5, 0.5).asDiagonal();
  Mat3 P = Mat3::Zero();
  P(0, 0) = 12;
  Mat3 expected = Mat3::Zero();
  expected(0, 0) = 48;
  EXPECT_EQ(cauchy_stress(P, F, 0.5), expected);
}

TEST(StressMeasures, CauchyStressMultipliesByFTransposed) {
  Mat3 F = Mat3::Identity(), P = Mat3::Zero();
  F(0, 1) = 3;  // simple shear
  P(0, 1) = 5;
  const Mat3 sigma = cauchy_stress(P, F, 1);
  EXPECT_EQ(sigma(0, 0), 15);  // P_01 F_01
  EXPECT_EQ(sigma(0, 1), 5);
  EXPECT_EQ(sigma(1, 0), 0);
}

TEST(StressMeasures, VonMisesOfUniaxialShearAndPressure) {
  Mat3 sigma = Mat3::Zero();
  sigma(2, 2) = -7;
  EXPECT_DOUBLE_EQ(von_mises(sigma), 7);
  EXPECT_DOUBLE_EQ(pressure(sigma), 7.0 / 3);
  sigma.setZero();
  sigma(0, 1) = sigma(1, 0) = 4;
  EXPECT_DOUBLE_EQ(von_mises(sigma), 4 * std::sqrt(3.0));
  EXPECT_EQ(pressure(sigma), 0);
  EXPECT_EQ(von_mises(6 * Mat3::Identity()), 0);
  EXPECT_EQ(pressure(6 * Mat3::Identity()), -6);
}

// principal stresses 1, 2, 4: sqrt(((1-2)^2 + (2-4)^2 + (4-1)^2)/2) = sqrt(7)
TEST(StressMeasures, VonMisesOfPrincipalStresses) {
  const Mat3 sigma = Eigen::Vector3d(1, 2, 4).asDiagonal();
  EXPECT_DOUBLE_EQ(von_mises(sigma), std::sqrt(7.0));
}

}  // namespace
}  // namespace diptych::cases
