#include "common/algebra/monomials.hpp"

#include <gtest/gtest.h>

namespace diptych::algebra {
namespace {

TEST(Monomials, AreCountedAndInOrder) {
  EXPECT_EQ(n_monomials(1, 3), 4);
  EXPECT_EQ(n_monomials(2, 3), 10);
  EXPECT_EQ(n_monomials(3, 3), 20);
  const Eigen::VectorXd m = monomials(Vec3(2, 3, 5), 3, 2);
  EXPECT_EQ(m, (Eigen::VectorXd(10) << 1, 2, 3, 5, 4, 6, 10, 9, 15, 25).finished());
  EXPECT_EQ(monomials(Vec3(2, 3, 5), 2, 1), Eigen::Vector3d(1, 2, 3));
}

TEST(Monomials, HaveTheirGradients) {
  const Vec3 X(0.3, -0.7, 1.1);
  constexpr double step = 1e-6;
  const Eigen::MatrixXd gradients = monomial_gradients(X, 3, 3);
  for (int i = 0; i < 3; ++i) {
    const Vec3 e = step * Vec3::Unit(i);
    const Eigen::VectorXd slope = (monomials(X + e, 3, 3) - monomials(X - e, 3, 3)) / (2 * step);
    EXPECT_LE((gradients.col(i) - slope).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace diptych::algebra
