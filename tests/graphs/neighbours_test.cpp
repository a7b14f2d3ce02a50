#include "sph/neighbours.hpp"

#include <gtest/gtest.h>

#include <random>

namespace diptych::sph {
namespace {

/// Radii over three octaves: pairs must be found across the cell lists of all of them.
TEST(Neighbours, AreThoseOfAllPairsOnAGradedCloud) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<Vec3> X;
  std::vector<double> radius;
  for (int a = 0; a < 700; ++a) {
    const double x = uniform(engine);
    X.emplace_back(x * x - 5, uniform(engine), 0.3 * uniform(engine));
    radius.push_back(0.02 + 0.25 * x * uniform(engine));
  }
  const Rows rows = find_neighbours(X, radius);
  for (size_t a = 0; a < X.size(); ++a) {
    std::vector<std::int32_t> expected;
    for (size_t b = 0; b < X.size(); ++b) {
      const double r_ab = 0.5 * (radius[a] + radius[b]);
      if (b != a && (X[b] - X[a]).norm() < r_ab) expected.push_back(static_cast<std::int32_t>(b));
    }
    const std::vector<std::int32_t> found(rows.neighbour.begin() + rows.row[a],
                                          rows.neighbour.begin() + rows.row[a + 1]);
    EXPECT_EQ(found, expected) << "particle " << a;
  }
}

}  // namespace
}  // namespace diptych::sph
