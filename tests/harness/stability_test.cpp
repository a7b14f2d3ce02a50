/// The bisection of the largest stable step against limits that are known exactly.

#include "benchmarks/cost/stability.hpp"

#include "benchmarks/run/scene.hpp"
#include "common/cases/reader.hpp"
#include "common/parallel/for_chunks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::harness {
namespace {

/// Uniaxial strain between rollers, 48 cells of length h; the cells are so wide that pairs across
/// the bar do not matter.
const char* const bar = R"(
[mesh]
element = "quadrilateral"
lower = [0, 0]
upper = [1, 1]
cells = [48, 1]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[[boundary]]
group = ["x_min", "x_max", "y_min", "y_max"]
type = "symmetry"
[fvm]
stencil = "edge"
[time]
end = 0.1
)";

/// c_p dt / h at the limit.
double courant_number(const std::string& integrator, const std::string& reconstruction) {
  const cases::Case setup =
      cases::case_from_text(bar, "bar", {"scheme.reconstruction=" + reconstruction});
  const scheme::PairGraph graph = graph_of(setup, "fvm", 0).graph;
  parallel::set_threads(1);
  int n_trials = 0;
  const StabilityLimit limit = stability_limit(setup, graph, integrator, {},
                                               [&](double, const StabilityTrial&) { ++n_trials; });
  EXPECT_LE(n_trials, 16);
  const cases::MaterialCase& m = setup.material;
  return std::sqrt((m.lame + 2 * m.shear_modulus) / m.density) * limit.dt * 48;
}

// Von Neumann limits of the one-dimensional scheme (central fluxes, full upwind dissipation of the
// momentum alone): R(dt lambda) with lambda = d/2 +- (d^2/4 - sin^2)^(1/2), d = cos - 1 without and
// -(1 - cos)^2/2 with reconstruction. All three are set by the mode of two cells, whose rate is -2
// c/h; the 48 cells have one at 47/48 of it. 2 %: half of it is the precision of the bisection.
TEST(Stability, FindsTheLimitOfSspRk3) {
  EXPECT_NEAR(courant_number("ssp-rk3", "linear"), 1.256, 0.02 * 1.256);
}

// the same mode against the real extent of its amplification, 5.15
TEST(Stability, FindsTheLimitOfSspRk43) {
  EXPECT_NEAR(courant_number("ssp-rk43", "linear"), 2.575, 0.02 * 2.575);
}

TEST(Stability, FindsTheLimitOfSspRk2WithoutReconstruction) {
  EXPECT_NEAR(courant_number("ssp-rk2", "none"), 1.0, 0.02);
}

TEST(Stability, FindsTheLimitOfLeapfrog) {
  EXPECT_NEAR(courant_number("leapfrog", "linear"), 1.0, 0.02);
}

}  // namespace
}  // namespace diptych::harness
