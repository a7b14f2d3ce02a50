/// Duals against closed forms and against differences.

#include "common/algebra/tensor.hpp"

#include <gtest/gtest.h>

namespace diptych::algebra {
namespace {

using Scalar = Dual<double, 2>;

// x and y at (1.3, 0.7)
const Scalar x{1.3, {1, 0}}, y{0.7, {0, 1}};

void expect(const Scalar& a, double v, double d0, double d1) {
  EXPECT_NEAR(a.v, v, 1e-14 * (1 + std::abs(v)));  // a few roundings
  EXPECT_NEAR(a.d[0], d0, 1e-14 * (1 + std::abs(d0)));
  EXPECT_NEAR(a.d[1], d1, 1e-14 * (1 + std::abs(d1)));
}

TEST(Dual, CarriesDerivativesThroughEveryOperation) {
  expect(x + y, 2.0, 1, 1);
  expect(x - y, 0.6, 1, -1);
  expect(x * y, 0.91, 0.7, 1.3);
  expect(x / y, 1.3 / 0.7, 1 / 0.7, -1.3 / 0.49);
  expect(2.0 / y, 2 / 0.7, 0, -2 / 0.49);
  expect(3.0 * x + 1.0 - 2.0, 2.9, 3, 0);
  expect(x * 3.0, 3.9, 3, 0);
  expect(1.0 + x, 2.3, 1, 0);
  expect(natural_log(x * y), std::log(0.91), 1 / 1.3, 1 / 0.7);
  expect(cube_root(x), std::cbrt(1.3), std::cbrt(1.3) / 3.9, 0);
  Scalar sum = x;
  sum += y;
  sum -= 2.0 * x;
  expect(sum, -0.6, -1, 1);
}

TEST(Dual, OfLanesHoldsEightOfThem) {
  Dual<Lanes, 2> a, b;
  for (int lane = 0; lane < n_lanes; ++lane) {
    a.v[lane] = 1 + lane;
    b.v[lane] = 2 - 0.1 * lane;
    for (int k = 0; k < 2; ++k) {
      a.d[k][lane] = k == 0;
      b.d[k][lane] = k == 1;
    }
  }
  const auto c = cube_root(a) / b + natural_log(b);
  for (int lane = 0; lane < n_lanes; ++lane) {
    const Scalar u{a.v[lane], {1, 0}}, w{b.v[lane], {0, 1}};
    const Scalar single = cube_root(u) / w + natural_log(w);
    EXPECT_DOUBLE_EQ(c.v[lane], single.v);
    EXPECT_DOUBLE_EQ(c.d[0][lane], single.d[0]);
    EXPECT_NEAR(c.d[1][lane], single.d[1], 1e-15);  // a sum that cancels
  }
}

TEST(Dual, IsAScalarOfTensors) {
  // det of [[x, 1, 0], [0, y, 2], [0, 0, x]] = x^2 y
  Tensor<Scalar> F = identity<Scalar>();
  F(0, 0) = F(2, 2) = x;
  F(1, 1) = y;
  F(0, 1) = Scalar{} + 1.0;
  F(1, 2) = Scalar{} + 2.0;
  expect(determinant(F, cofactor(F)), 1.3 * 1.3 * 0.7, 2 * 1.3 * 0.7, 1.3 * 1.3);
}

}  // namespace
}  // namespace diptych::algebra
