/// Bodies with several rigid walls: thrown into a corner, and to and fro between two walls.

#include "common/parallel/for_chunks.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <numbers>
#include <string>
#include <vector>

namespace diptych {
namespace {

using algebra::Vec3;
using tests::Scene;
using tests::scene_of;

/// L = 1 m, c_p = 100 m/s. All sides may touch all walls.
const char* const block = R"([mesh]
element = "quadrilateral"
lower = [0, 0]
upper = [1, 1]
cells = [8, 8]
[material]
model = "neo-hookean-isochoric"
density = 1000
youngs_modulus = 1e7
poissons_ratio = 0
[[boundary]]
group = ["x_min", "x_max", "y_min", "y_max"]
type = "rigid-wall"
)";
const char* const second = R"([[boundary]]
group = ["x_min", "x_max", "y_min", "y_max"]
type = "rigid-wall"
)";

class WallCorner : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  void SetUp() override { parallel::set_threads(1); }  // a few hundred nodes
  void TearDown() override { parallel::set_threads(0); }
  Scene scene(const std::string& text, std::vector<std::string> overrides = {}) const {
    overrides.push_back(std::string("time.integrator=\"") + std::get<1>(GetParam()) + "\"");
    return scene_of(std::get<0>(GetParam()), text, overrides);
  }
};
INSTANTIATE_TEST_SUITE_P(Both,
                         WallCorner,
                         testing::Combine(testing::Values("sph", "fvm"),
                                          testing::Values("leapfrog", "ssp-rk3")));

/// Corner, block and velocity are turned about the corner of the block.
std::string thrown_into_corner(double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
  };
  const double gap = 0.01;
  return block + fmt::format("point = {}\nnormal = {}\n", turned(-gap, 0), turned(1, 0)) + second +
         fmt::format("point = {}\nnormal = {}\n", turned(0, -gap), turned(0, 1)) +
         fmt::format("[initial]\nvelocity = {}\n", turned(-3, -3)) +
         fmt::format(
             "displacement = [\"({0:.17g} - 1)*x - {1:.17g}*y\", "
             "\"{1:.17g}*x + ({0:.17g} - 1)*y\"]\n",
             c, s) +
         "[time]\nend = 0.05\n";
}

TEST_P(WallCorner, ABlockThatFallsIntoACornerComesBackTheWayItCame) {
  Scene s = scene(thrown_into_corner(0));
  run::Solver& solver = *s.solver;
  const scheme::Balance start = solver.balance();
  const double energy = start.kinetic;
  double deepest = 0, impulse_apart = 0, force_apart = 0, largest_force = 0;
  while (solver.time() < s.setup.time.end) {
    solver.step(s.setup.time.end);
    const scheme::Balance now = solver.balance();
    const Vec3 apart = now.linear_momentum - start.linear_momentum - solver.audit().impulse.linear;
    impulse_apart = std::max(impulse_apart, apart.norm());
    for (const scheme::BoundaryPatch& side : s.graph.patches) {
      for (const Vec3& u : solver.snapshot(side.nodes).u)
        if (side.name == "x_min") deepest = std::min(deepest, u.x() + 0.01);
    }
    const Vec3 force = solver.reaction(s.graph.patches[0].nodes);
    largest_force = std::max(largest_force, force.norm());
    force_apart = std::max(force_apart, -force.x());
  }
  EXPECT_GE(deepest, -1e-15) << "no node is behind the wall";
  EXPECT_LE(impulse_apart, 1e-12 * start.linear_momentum.norm());
  EXPECT_GT(largest_force, 1e4) << "rho c v of a side of 1 m is 3e5 N";
  EXPECT_LE(force_apart, 0.03 * largest_force) << "the wall does not pull";

  // it is its own mirror image about the diagonal, and leaves with most of its speed
  const scheme::Balance end = solver.balance();
  const Vec3 p = end.linear_momentum;
  EXPECT_NEAR(p.x(), p.y(), 1e-9 * p.norm());
  EXPECT_GT(p.x(), -0.7 * start.linear_momentum.x());
  EXPECT_LT(solver.audit().external_work, 0) << "walls take and do not give";
  EXPECT_EQ(solver.audit().contact_loss, -solver.audit().external_work);
  EXPECT_LT(end.kinetic + end.strain, energy);
}

/// At strains of 0.6 % with nu = 0 the two blows hardly know of each other: a corner takes of the
/// energy what a wall takes of a block that flies straight at it, and the budget closes as well.
TEST_P(WallCorner, ACornerTakesWhatAWallTakesOfEachDirection) {
  struct Share {
    double work, residual;
  };
  const auto share = [&](const char* velocity) {
    Scene s = scene(thrown_into_corner(0), {std::string("initial.velocity=") + velocity});
    const scheme::Balance start = s.solver->balance();
    tests::run_to(*s.solver, s.setup.time.end);
    const scheme::Balance end = s.solver->balance();
    const scheme::Audit& audit = s.solver->audit();
    const double residual = end.kinetic + end.strain - start.kinetic + audit.numerical_dissipation -
                            audit.external_work;
    return Share{audit.external_work / start.kinetic, residual / start.kinetic};
  };
  const Share corner = share("[-0.6,-0.6]"), wall = share("[-0.6,0]"), other = share("[0,-0.6]");
  EXPECT_LT(wall.work, -0.01);
  EXPECT_NEAR(corner.work, wall.work, 0.01 * std::abs(wall.work));
  EXPECT_NEAR(corner.work, other.work, 0.01 * std::abs(wall.work));
  EXPECT_NEAR(corner.residual, wall.residual, 0.1 * std::abs(wall.residual));
}

/// Walls along the axes round nothing; of others each impulse changes the last digits that the
/// other wall sees.
TEST_P(WallCorner, HowTheCornerIsTurnedDoesNotMatterToTheNodeInIt) {
  for (const double degrees : {0.0, -20.0, 33.0}) {
    Scene s = scene(thrown_into_corner(degrees));
    const double angle = degrees * std::numbers::pi / 180;
    const double c = std::cos(angle), sine = std::sin(angle);
    const std::vector<std::int32_t> corner{0};
    bool has_been_in_it = false;
    while (s.solver->time() < 0.008) {
      s.solver->step(0.008);
      const Vec3 u = s.solver->snapshot(corner).u[0];
      const double first = u.x() * c + u.y() * sine + 0.01, other = u.y() * c - u.x() * sine + 0.01;
      EXPECT_GE(std::min(first, other), -1e-14) << degrees;
      has_been_in_it = has_been_in_it || std::max(first, other) < 1e-14;
    }
    EXPECT_TRUE(has_been_in_it) << degrees;
  }
}

TEST_P(WallCorner, ABlockBetweenTwoWallsComesBackFromEach) {
  Scene s = scene(block + std::string("point = [-0.01, 0]\nnormal = [1, 0]\n") + second +
                  "point = [1.01, 0]\nnormal = [-1, 0]\n" +
                  "[initial]\nvelocity = [-3, 0]\n[time]\nend = 0.085\n");
  std::vector<int> signs;
  while (s.solver->time() < s.setup.time.end) {
    s.solver->step(s.setup.time.end);
    const double p = s.solver->balance().linear_momentum.x();
    const int sign = p < -500 ? -1 : p > 500 ? 1 : 0;  // of 3000 N s
    if (sign != 0 && (signs.empty() || signs.back() != sign)) signs.push_back(sign);
  }
  // 3.3 ms, then 20 ms on the wall, some 8 ms, 20 ms, 10 ms, 20 ms
  EXPECT_THAT(signs, testing::ElementsAre(-1, 1, -1, 1));
}

TEST(WallCornerInput, ObliqueWallsShareNoNode) {
  EXPECT_THAT(tests::refusal_of("fvm",
                                block + std::string("point = [-1, 0]\nnormal = [1, 0]\n") + second +
                                    "point = [-1, 0]\nnormal = [1, 1]\n[time]\nend = 1\n",
                                {}),
              testing::HasSubstr("neither at right angles nor opposite"));
}

}  // namespace
}  // namespace diptych
