/// Eight lanes compute what eight scalars compute.

#include "common/algebra/lanes.hpp"

#include "common/algebra/positive_lanes.hpp"
#include "common/algebra/tensor.hpp"
#include "tests/common/physics/random_states.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

using namespace diptych::algebra;
using diptych::tests::RandomStates;

// Same operations in the same order; contraction to fused multiply-adds may differ between the two.
constexpr double four_ulp = 4 * std::numeric_limits<double>::epsilon();

TEST(Lanes, ScalarFunctionsActOnEachLane) {
  const Lanes a = {0.25, 1, 2, 3, 1e-300, 1e300, 7, 0.5};
  const Lanes s = {-1, 0, 2, -3, 4, -5, 0, 7};
  for (int i = 0; i < n_lanes; ++i) {
    EXPECT_EQ(square_root(a)[i], std::sqrt(a[i]));
    // within 4 ulp: the compiler may have evaluated one side itself, correctly rounded
    EXPECT_DOUBLE_EQ(natural_log(a)[i], std::log(a[i]));
    EXPECT_DOUBLE_EQ(cube_root(a)[i], std::cbrt(a[i]));
    EXPECT_EQ(magnitude(s)[i], std::fabs(s[i]));
    EXPECT_EQ(larger(a, s)[i], std::fmax(a[i], s[i]));
    EXPECT_EQ(smaller(a, s)[i], std::fmin(a[i], s[i]));
    EXPECT_EQ(inverse_or_zero(s)[i], s[i] == 0 ? 0 : 1 / s[i]);
    EXPECT_EQ(inverse_or_zero(s)[i], inverse_or_zero(double(s[i])));
  }
}

TEST(Lanes, LoadAndStoreKeepTheOrder) {
  std::array<double, n_lanes> in{}, out{};
  for (int i = 0; i < n_lanes; ++i)
    in[i] = i + 0.5;
  store(out.data(), load(in.data()));
  EXPECT_EQ(in, out);
}

TEST(Lanes, SumIsATreeOfFixedShape) {
  // the order of additions shows in the rounding: 1 is lost beside 1e16 unless it meets -1e16 last
  const Lanes a = {1e16, 1, 0, 0, -1e16, 0, 0, 0};
  EXPECT_EQ(lane_sum(a), 1);
  const Lanes b = {1e16, -1e16, 0, 0, 1, 0, 0, 0};
  EXPECT_EQ(lane_sum(b), 0);
  const Lanes c = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(lane_sum(c), 36);
}

TEST(Lanes, LargestEigenvalueBoundAgreesWithTheScalarOne) {
  RandomStates random(21);
  for (int n = 0; n < 200; ++n) {
    SymmetricTensor<double> A[n_lanes];
    SymmetricTensor<Lanes> packed;
    for (int i = 0; i < n_lanes; ++i) {
      A[i] = i == 0 ? SymmetricTensor<double>{} : random.positive_definite(i == 1 ? 1.0001 : 5);
      for (int k = 0; k < 6; ++k)
        packed.s[k][i] = A[i].s[k];
    }
    const Lanes bound = largest_eigenvalue_bound(packed);
    for (int i = 0; i < n_lanes; ++i) {
      const double scalar = largest_eigenvalue_bound(A[i]);
      EXPECT_NEAR(bound[i], scalar, four_ulp * scalar) << i;
    }
  }
}

TEST(Lanes, CofactorAndInverseAgreeWithTheScalarOnes) {
  RandomStates random(22);
  Tensor<Lanes> F;
  SymmetricTensor<Lanes> A;
  Tensor<double> F_of[n_lanes];
  SymmetricTensor<double> A_of[n_lanes];
  for (int i = 0; i < n_lanes; ++i) {
    F_of[i] = random.deformation_gradient(2);
    A_of[i] = random.positive_definite(3);
    for (int k = 0; k < 9; ++k)
      F(k / 3, k % 3)[i] = F_of[i](k / 3, k % 3);
    for (int k = 0; k < 6; ++k)
      A.s[k][i] = A_of[i].s[k];
  }
  const auto H = cofactor(F);
  const auto B = inverse(A);
  for (int i = 0; i < n_lanes; ++i) {
    const auto H_i = cofactor(F_of[i]);
    const auto B_i = inverse(A_of[i]);
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(H(k / 3, k % 3)[i], H_i(k / 3, k % 3), four_ulp * to_eigen(H_i).norm());
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(B.s[k][i], B_i.s[k], four_ulp * to_eigen(B_i).norm());
  }
}

TEST(Lanes, ArePositiveWhereAllValuesAre) {
  Lanes good, bad;
  for (int i = 0; i < n_lanes; ++i) {
    good[i] = 1e-300;
    bad[i] = i + 1;
  }
  for (const double value : {0.0, -0.0, -1.0, std::nan("")}) {
    for (int i = 0; i < n_lanes; ++i) {
      Lanes one = bad;
      one[i] = value;
      PositiveLanes positive;
      EXPECT_TRUE(positive.all());
      positive.keep(good);
      EXPECT_TRUE(positive.all());
      positive.keep(one);
      EXPECT_FALSE(positive.all());
      positive.keep(good);  // what was lost stays lost
      for (int k = 0; k < n_lanes; ++k)
        EXPECT_EQ(positive.at(k), k != i) << value;
    }
  }
}

}  // namespace
