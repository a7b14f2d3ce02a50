/// Norms of states that are known: a stretch by k over a box of volume 2.

#include "common/run/field_norms.hpp"

#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych {
namespace {

const char* const stretched = R"([parameters]
k = 0.1
[mesh]
upper = [2, 1, 1]
cells = [4, 2, 2]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[initial]
displacement = ["k*x", 0, 0]
velocity = [0, 3, 0]
[time]
end = 1
)";

TEST(FieldNorms, AreThoseOfKnownFields) {
  tests::Scene s = tests::scene_of("fvm", stretched);
  const auto norms = run::field_norms(s.graph, s.solver->snapshot());
  const double volume = 2;
  EXPECT_NEAR(norms.at("velocity"), 3 * std::sqrt(volume), 1e-13);
  EXPECT_NEAR(norms.at("deformation_gradient"), 0.1 * std::sqrt(volume), 1e-13);
  EXPECT_GT(norms.at("stress"), 1e4);
  EXPECT_GT(norms.at("displacement"), 0.1);
}

TEST(DifferenceNorms, AreThoseOfTheDifferenceOfTheFields) {
  tests::Scene s = tests::scene_of("fvm", stretched);
  tests::Scene t = tests::scene_of("fvm", stretched, {"parameters.k=0.3"});
  const auto u = s.solver->snapshot(), v = t.solver->snapshot();
  const auto differences = run::difference_norms(s.graph, u, v);
  EXPECT_NEAR(differences.at("deformation_gradient"), 0.2 * std::sqrt(2.0), 1e-13);
  EXPECT_NEAR(differences.at("displacement"), 2 * run::field_norms(s.graph, u).at("displacement"),
              1e-13);
  EXPECT_EQ(differences.at("velocity"), 0);
  EXPECT_EQ(run::difference_norms(s.graph, u, u).at("stress"), 0);
}

}  // namespace
}  // namespace diptych
