/// Values between the nodes of a lattice.

#include "common/run/interpolation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace diptych::run {
namespace {

/// n^3 nodes at a spacing of 0.5, node i + n (j + n k) at (i, j, k)/2, with a cell between each
/// eight.
class Lattice {
 public:
  explicit Lattice(int n) : n_(n) {
    for (int a = 0; a < n * n * n; ++a)
      X.emplace_back(0.5 * (a % n), 0.5 * (a / n % n), 0.5 * (a / n / n));
  }
  Interpolation at(const Vec3& place) const {
    const auto around = [this](std::int32_t a, std::vector<std::int32_t>& nodes) {
      for (std::int32_t b = 0; b < std::ssize(X); ++b)
        if ((X[b] - X[a]).cwiseAbs().maxCoeff() < 0.6) nodes.push_back(b);
    };
    std::vector<std::int32_t> corners;
    for (std::int32_t a = 0; a < std::ssize(X); ++a)
      if ((X[a] - place).cwiseAbs().maxCoeff() < 0.5 + 1e-9) corners.push_back(a);
    return interpolation_at(place, X, 3, nearest_nodes(place, X, corners, around), 0.5, around);
  }
  double error(const Vec3& place, double (*function)(const Vec3&)) const {
    const Interpolation found = at(place);
    double sum = -function(place);
    for (size_t k = 0; k < found.nodes.size(); ++k)
      sum += found.weights[k] * function(X[found.nodes[k]]);
    return std::abs(sum);
  }
  std::vector<Vec3> X;

 private:
  int n_;
};

double quadratic(const Vec3& X) {
  return 1 + X[0] - 2 * X[1] + X[0] * X[2] - 3 * X[1] * X[1] + X[2] * X[2];
}
double linear(const Vec3& X) {
  return 1 + X[0] - 2 * X[1] + 3 * X[2];
}

TEST(Interpolation, IsExactForQuadraticsInsideAndAtSidesEdgesAndCorners) {
  const Lattice lattice(5);
  for (const Vec3& place : {Vec3(0.9, 1.1, 1.23), Vec3(0, 0.77, 1.1), Vec3(0, 0, 0.66),
                            Vec3(0.1, 0.12, 0.13), Vec3(1.95, 0.01, 1.99)})
    EXPECT_LE(lattice.error(place, quadratic), 1e-12) << place.transpose();
}

TEST(Interpolation, TakesANodeThatIsThere) {
  const Lattice lattice(4);
  const Interpolation found = lattice.at({0.5, 1, 1.5});
  ASSERT_EQ(found.nodes.size(), 1U);
  EXPECT_EQ(found.weights[0], 1);
  EXPECT_EQ(lattice.X[found.nodes[0]], Vec3(0.5, 1, 1.5));
}

TEST(Interpolation, IsExactForLinearFieldsInOneCell) {
  const Lattice lattice(2);
  EXPECT_LE(lattice.error({0.2, 0.1, 0.4}, linear), 1e-13);
  EXPECT_GT(lattice.error({0.2, 0.1, 0.4}, quadratic), 1e-3) << "eight nodes, ten monomials";
}

// Where eight nodes are as near, to rounding, the neighbours of one of them would lean to its side.
TEST(Interpolation, IsSymmetricInTheMiddleOfACell) {
  const Lattice lattice(6);
  const Vec3 middle(1.25, 1.25 + 1e-14, 1.25 - 1e-14);
  const Interpolation found = lattice.at(middle);
  ASSERT_EQ(found.nodes.size(), 64U);
  Vec3 first_odd = Vec3::Zero();
  for (size_t k = 0; k < found.nodes.size(); ++k) {
    EXPECT_NEAR(found.weights[k], found.weights[63 - k], 1e-12);
    const Vec3 r = lattice.X[found.nodes[k]] - middle;
    first_odd += found.weights[k] * r.cwiseProduct(r).cwiseProduct(r);
  }
  EXPECT_LE(first_odd.norm(), 1e-12);
}

}  // namespace
}  // namespace diptych::run
