#include "common/run/default_cfl.hpp"

#include "common/run/case_reader.hpp"
#include "fvm/fvm_graph.hpp"
#include "meshes/generators.hpp"

#include <gtest/gtest.h>

namespace diptych::run {
namespace {

const char* const block = R"(
[mesh]
element = "quadrilateral"
lower = [0, 0]
upper = [1, 1]
cells = [16, 16]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[time]
end = 1
)";

double cfl(const std::vector<std::string>& overrides, const char* integrator = "leapfrog") {
  const Case setup = case_from_text(block, "block", overrides);
  const auto mesh = meshes::box(meshes::CellType::quadrilateral, setup.mesh.lower, setup.mesh.upper,
                                setup.mesh.cells);
  return default_cfl(setup, fvm::build_graph(mesh, {}), time::integrator_menu().at(integrator));
}

double share(const std::array<int, 2>& cells, double shear_ratio) {
  const auto mesh =
      meshes::box(meshes::CellType::quadrilateral, {0, 0, 0}, {1, 1, 0}, {cells[0], cells[1], 1});
  return dissipation_share(fvm::build_graph(mesh, {}), shear_ratio);
}

// The mode of two cells in every direction: rate 2 (c_p + c_s)/h on squares, where the graph rate
// is 2 c_p/h. 3 %: thirty power iterations, from below.
TEST(DefaultCfl, KnowsTheShareOfTheDissipationOnALattice) {
  EXPECT_NEAR(share({24, 24}, 0.5), 0.75, 0.03 * 0.75);
  EXPECT_LE(share({24, 24}, 0.5), 0.75 + 1e-12);
  EXPECT_NEAR(share({24, 24}, 1), 1, 0.03);
  EXPECT_NEAR(share({256, 1}, 0.5), 1, 0.03);
}

TEST(DefaultCfl, IsTheIntegratorsOwnOnSquares) {
  for (const char* name : {"leapfrog", "ssp-rk2", "ssp-rk3"})
    EXPECT_EQ(cfl({}, name), time::integrator_menu().at(name).default_cfl) << name;
}

// c dt/h = 1 is the limit of leapfrog along one direction; 3 % as above
TEST(DefaultCfl, StaysBelowTheLimitAlongOneDirection) {
  const double one = cfl({"mesh.cells=[256,1]"});
  EXPECT_LT(one, 0.95 * 1.03);
  EXPECT_GE(one, 0.95);
}

TEST(DefaultCfl, FallsWithStrongerDissipationButDoesNotRiseWithWeaker) {
  EXPECT_NEAR(cfl({"scheme.dissipation=4"}), cfl({"scheme.dissipation=2"}) / 2, 1e-12);
  EXPECT_LT(cfl({"scheme.dissipation=2"}), 0.7);
  EXPECT_LT(cfl({"scheme.dissipation=2"}, "ssp-rk3"), 0.8);
  EXPECT_EQ(cfl({"scheme.dissipation=0"}), 1.2);
}

TEST(DefaultCfl, KnowsTheRealExtentOfTheIntegrators) {
  EXPECT_NEAR(real_extent(time::integrator_menu().at("ssp-rk2")), 2, 2e-3);
  EXPECT_NEAR(real_extent(time::integrator_menu().at("ssp-rk3")), 2.5127, 2e-3);
}

}  // namespace
}  // namespace diptych::run
