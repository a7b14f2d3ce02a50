/// The closed bound of the largest eigenvalue: never below it, and close, above all where two or
/// three eigenvalues coincide.

#include "common/algebra/tensor.hpp"
#include "tests/common/physics/random_states.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace diptych::algebra;
using diptych::tests::eigenvalues;
using diptych::tests::RandomStates;

/// Bound minus largest eigenvalue, in units of the tensor's norm.
double excess(const Mat3& A) {
  const double largest = eigenvalues(A)[2];
  return (largest_eigenvalue_bound(to_symmetric(A)) - largest) / A.norm();
}

Mat3 with_eigenvalues(const Vec3& values, RandomStates& random) {
  const Mat3 R = random.rotation();
  const Mat3 A = R * values.asDiagonal() * R.transpose();
  return 0.5 * (A + A.transpose());
}

// Below: rounding of a handful of operations and of Eigen's own. Above: the documented 1e-7.
constexpr double below = -1e-14, above = 1e-7;

TEST(LargestEigenvalueBound, IsSafeAndTightForDistinctEigenvalues) {
  RandomStates random(11);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 values(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double e = excess(with_eigenvalues(values, random));
    ASSERT_GE(e, below) << values.transpose();
    ASSERT_LE(e, above) << values.transpose();
  }
}

TEST(LargestEigenvalueBound, IsSafeAndTightWhereEigenvaluesCoincide) {
  RandomStates random(12);
  for (int n = 0; n < 20000; ++n) {
    const double a = random.uniform(-1, 1), b = random.uniform(-1, 1);
    const double split = n % 3 == 0 ? 0 : random.factor(1e6) * 1e-8;  // exactly or nearly equal
    const Vec3 values(a, a + split, n % 5 == 0 ? a - split : b);
    const double e = excess(with_eigenvalues(values, random));
    ASSERT_GE(e, below) << values.transpose() << " split " << split;
    ASSERT_LE(e, above) << values.transpose() << " split " << split;
  }
}

TEST(LargestEigenvalueBound, IsSafeNearTheIdentityAndAtEveryScale) {
  RandomStates random(13);
  for (int n = 0; n < 20000; ++n) {
    const double deviation = std::pow(10, -random.uniform(0, 16));
    const Vec3 values = Vec3::Ones() + deviation * 0.5 * Vec3(random.uniform(-1, 1), -0.3, -0.3);
    const double e = excess(random.factor(1e12) * with_eigenvalues(values, random));
    ASSERT_GE(e, below) << deviation;
    ASSERT_LE(e, above) << deviation;
  }
}

TEST(LargestEigenvalueBound, IsExactForMultiplesOfTheIdentity) {
  EXPECT_EQ(largest_eigenvalue_bound(SymmetricTensor<double>{}), 0);
  // q = trace/3 rounds once, so twice that is allowed
  EXPECT_NEAR(largest_eigenvalue_bound(7.3 * symmetric_identity<double>()), 7.3, 4e-15);
  EXPECT_NEAR(largest_eigenvalue_bound(-2.0 * symmetric_identity<double>()), -2, 2e-15);
}

/// As ahead of a wave, where deviations decay through the whole range of numbers.
TEST(LargestEigenvalueBound, StaysFiniteForVanishingDeviations) {
  for (int n = 40; n < 646; ++n) {
    const double deviation = std::pow(10, -0.5 * n);
    SymmetricTensor<double> A = 3e7 * symmetric_identity<double>();
    A(0, 1) = deviation;
    ASSERT_NEAR(largest_eigenvalue_bound(A), 3e7, 1) << deviation;
  }
}

TEST(LargestEigenvalueBound, PassesNotANumberOn) {
  SymmetricTensor<double> A = symmetric_identity<double>();
  A(0, 1) = std::nan("");
  EXPECT_TRUE(std::isnan(largest_eigenvalue_bound(A)));
}

}  // namespace
