/// 3x3 tensors of hot code against Eigen and against the identities of the tensor cross product.

#include "common/algebra/tensor.hpp"

#include "tests/common/physics/random_states.hpp"

#include <gtest/gtest.h>

namespace {

using namespace diptych::algebra;
using diptych::tests::distance;
using diptych::tests::RandomStates;

// Sums of at most nine products of order one: a few roundings.
constexpr double rounding = 1e-14;

/// (A x B)_iI = e_ijk e_IJK A_jJ B_kK, written out as the paper defines it.
Mat3 cross_by_definition(const Mat3& A, const Mat3& B) {
  const auto e = [](int i, int j, int k) { return (j - i) * (k - i) * (k - j) / 2; };
  Mat3 R = Mat3::Zero();
  for (int n = 0; n < 729; ++n) {
    const int i = n % 3, j = n / 3 % 3, k = n / 9 % 3;
    const int I = n / 27 % 3, J = n / 81 % 3, K = n / 243;
    R(i, I) += e(i, j, k) * e(I, J, K) * A(j, J) * B(k, K);
  }
  return R;
}

TEST(Tensor, SymmetricStorageIsInTheOrder11_22_33_12_13_23) {
  SymmetricTensor<double> A = {{11, 22, 33, 12, 13, 23}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(A(i, i), 11 * (i + 1));
    for (int j = i + 1; j < 3; ++j) {
      EXPECT_EQ(A(i, j), 10 * (i + 1) + j + 1);
      EXPECT_EQ(A(j, i), A(i, j));
    }
  }
}

TEST(Tensor, ProductsAgreeWithEigen) {
  RandomStates random(1);
  for (int n = 0; n < 100; ++n) {
    const auto A = random.tensor(), B = random.tensor();
    const auto S = random.positive_definite(3);
    const auto a = random.direction();
    const Mat3 eA = to_eigen(A), eB = to_eigen(B), eS = to_eigen(S);
    const Vec3 ea = to_eigen(a);
    EXPECT_LT(distance(to_eigen(product(A, B)), eA * eB), rounding);
    EXPECT_LT(distance(to_eigen(product(A, S)), eA * eS), 3 * rounding);
    EXPECT_LT((to_eigen(product(A, a)) - eA * ea).norm(), rounding);
    EXPECT_LT((to_eigen(product(S, a)) - eS * ea).norm(), 3 * rounding);
    EXPECT_EQ(to_eigen(transpose(A)), eA.transpose());
    EXPECT_LT(distance(to_eigen(transpose_times_self(A)), eA.transpose() * eA), rounding);
    EXPECT_NEAR(contract(A, B), (eA.array() * eB.array()).sum(), rounding);
    EXPECT_NEAR(contract(S, S), eS.squaredNorm(), 30 * rounding);
    EXPECT_NEAR(quadratic(S, a), ea.dot(eS * ea), 3 * rounding);
    EXPECT_NEAR(trace(S), eS.trace(), rounding);
  }
}

TEST(Tensor, CrossProductIsThatOfThePaper) {
  RandomStates random(2);
  for (int n = 0; n < 50; ++n) {
    const auto A = random.tensor(), B = random.tensor();
    EXPECT_LT(distance(to_eigen(cross(A, B)), cross_by_definition(to_eigen(A), to_eigen(B))),
              rounding);
    const auto S = random.positive_definite(3), U = random.positive_definite(3);
    EXPECT_LT(distance(to_eigen(cross(S, U)), cross_by_definition(to_eigen(S), to_eigen(U))),
              30 * rounding);
  }
}

TEST(Tensor, CrossProductDistributesOverProducts) {
  RandomStates random(3);
  for (int n = 0; n < 50; ++n) {
    const auto A = random.tensor(), B = random.tensor(), U = random.tensor(), V = random.tensor();
    // (A x B)(U x V) = AU x BV + AV x BU
    const auto left = product(cross(A, B), cross(U, V));
    const auto right = cross(product(A, U), product(B, V)) + cross(product(A, V), product(B, U));
    EXPECT_LT(distance(left, right), 10 * rounding);
    // M x I = tr(M) I - M^T
    const auto I = identity<double>();
    const double trace_A = A(0, 0) + A(1, 1) + A(2, 2);
    EXPECT_LT(distance(cross(A, I), trace_A * I - transpose(A)), rounding);
  }
}

TEST(Tensor, CofactorIsHalfOfFCrossFAndGivesTheInverse) {
  RandomStates random(4);
  for (int n = 0; n < 100; ++n) {
    const auto F = random.deformation_gradient(3);
    const auto H = cofactor(F);
    const double J = determinant(F, H);
    EXPECT_LT(distance(H, 0.5 * cross(F, F)), 100 * rounding);
    EXPECT_NEAR(J, to_eigen(F).determinant(), 1e-13 * to_eigen(F).norm() * to_eigen(H).norm());
    EXPECT_GT(J, 0);
    // H^T F = J I
    EXPECT_LT(distance(product(transpose(H), F), J * identity<double>()),
              rounding * to_eigen(H).norm() * to_eigen(F).norm());
  }
}

TEST(Tensor, SymmetricInverseAndDeterminantAgreeWithEigen) {
  RandomStates random(5);
  for (int n = 0; n < 100; ++n) {
    const auto S = random.positive_definite(10);  // condition number up to 100
    EXPECT_LT(distance(to_eigen(inverse(S)) * to_eigen(S), Mat3::Identity()), 1e-12);
    EXPECT_NEAR(determinant(S) / to_eigen(S).determinant(), 1, 1e-12);
    EXPECT_LT(distance(to_eigen(cofactor(S)), determinant(S) * to_eigen(S).inverse()),
              1e-13 * to_eigen(S).squaredNorm());
  }
}

TEST(Tensor, VectorProductsAgreeWithEigen) {
  RandomStates random(6);
  for (int n = 0; n < 20; ++n) {
    const auto a = random.direction(), b = random.direction();
    EXPECT_LT((to_eigen(cross(a, b)) - to_eigen(a).cross(to_eigen(b))).norm(), rounding);
    EXPECT_NEAR(dot(a, b), to_eigen(a).dot(to_eigen(b)), rounding);
    EXPECT_LT(distance(to_eigen(outer(a, b)), to_eigen(a) * to_eigen(b).transpose()), rounding);
  }
}

}  // namespace
