#include "common/run/default_cfl.hpp"

#include "benchmarks/run/scene.hpp"
#include "common/cases/reader.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/run/largest_rates.hpp"
#include "common/scheme/sweeps/face_correction.hpp"
#include "fvm/fvm_graph.hpp"
#include "meshes/generators.hpp"
#include "meshes/renumber.hpp"
#include "sph/sph_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

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
[fvm]
stencil = "edge"
[time]
end = 1
)";

double cfl(const std::vector<std::string>& overrides, const char* integrator = "leapfrog") {
  const cases::Case setup = cases::case_from_text(block, "block", overrides);
  return default_cfl(setup, harness::graph_of(setup, "fvm", 0).graph,
                     time::integrator_menu().at(integrator));
}

scheme::PairGraph squares(int nx, int ny) {
  return fvm::build_graph(
      meshes::box(meshes::CellType::quadrilateral, {0, 0, 0}, {1.0 * nx, 1.0 * ny, 0}, {nx, ny, 1}),
      {});
}

/// The rates of a body of its own on a graph.
template <int Dim>
struct RatesOf {
  explicit RatesOf(const scheme::PairGraph& graph, double kappa_f = 0, bool cells = false)
      : body(graph, options(kappa_f, cells)), rates(body, kappa_f) {}
  LargestRates<Dim>* operator->() { return &rates; }

  scheme::Body<Dim> body;
  LargestRates<Dim> rates;

 private:
  static scheme::BodyOptions options(double kappa_f, bool cells) {
    scheme::BodyOptions options;
    options.face_correction = kappa_f != 0;
    options.volumes = cells ? scheme::Volumes::cells : scheme::Volumes::nodes;
    return options;
  }
};

constexpr double single = 2e-7;  // areas of the dissipation are kept in single precision

// The mode of two cells in every direction, of a body of spacing one: rate 2 (c_p + c_s). 2 %:
// sixteen Lanczos iterations, from below.
TEST(LargestRates, KnowTheDissipationOfALattice) {
  const auto graph = squares(24, 24);
  for (const double r : {0.15, 0.5, 1.0}) {
    EXPECT_NEAR(RatesOf<2>(graph)->dissipation(r), 2 * (1 + r), 0.02 * 2 * (1 + r)) << r;
    EXPECT_LE(RatesOf<2>(graph)->dissipation(r), 2 * (1 + r) * (1 + single)) << r;
  }
}

// A pressure wave: inside 1 along a line, at its free end sqrt(2): of the first two nodes u_0 alone
// moves, strains u_0 in Omega = 1/2 and u_0/2 in Omega = 1 give omega^2 = (1/2 + 1/4)/(1/2) and
// more. Both directions together are up to sqrt(2) times as fast, at the corners.
// Areas of edges stay on their lines; particles have neighbours in all directions, whose areas
// turn.
TEST(LargestRates, KnowTheDissipationOfTurnedAreas) {
  constexpr double r = 0.3;
  RatesOf<2> edges(squares(24, 24));
  EXPECT_NEAR(edges->dissipation_turned(r), edges->dissipation(r), 1e-6);
  const auto mesh =
      meshes::box(meshes::CellType::quadrilateral, {0, 0, 0}, {24, 24, 0}, {24, 24, 1});
  const scheme::PairGraph graph = sph::build_graph(mesh, {.kappa = 1.2});
  RatesOf<2> particles(graph);
  const double at_rest = particles->dissipation(r), turned = particles->dissipation_turned(r);
  EXPECT_GT(turned, 1.05 * at_rest);
  EXPECT_LT(turned, particles->dissipation(1)) << "z_p in all directions";
  EXPECT_EQ(particles->dissipation(r), at_rest) << "H is the identity again";
}

TEST(LargestRates, KnowTheFrequencyOfALatticeWithItsBoundary) {
  const auto graph = squares(24, 24);
  const double plain = RatesOf<2>(graph)->frequency({0.535});
  EXPECT_GT(plain, std::sqrt(2));
  EXPECT_LE(plain, 2 * (1 + 1e-12));
  // the correction raises it by no more than inside
  const double corrected = RatesOf<2>(graph, 1.0 / 6)->frequency({0.535});
  EXPECT_GT(corrected, 1.1 * plain);
  EXPECT_LE(corrected, plain * scheme::frequency_factor(1.0 / 6));
}

// At boundaries of SPH the divergence is the fastest where nu is near one half (notes 10.2).
TEST(LargestRates, CountTheDivergenceWhereItIsTheFastest) {
  const auto bar = meshes::box(meshes::CellType::hexahedron, {0, 0, 0}, {6, 2, 2}, {6, 2, 2});
  const auto particles = sph::build_graph(bar, {});
  RatesOf<3> sph(particles);
  EXPECT_GT(sph->frequency({0.0447}), 1.1 * sph->frequency({0.535}));  // nu = 0.499, 0.3
}

// What cells carry acts on their volumes: of a body whose cells carry nothing it changes nothing,
// and linearly in between, omega^2 being that of a sum of positive operators.
TEST(LargestRates, KnowTheVolumesOfCells) {
  const auto bar = meshes::box(meshes::CellType::hexahedron, {0, 0, 0}, {6, 2, 2}, {6, 2, 2});
  const auto particles = sph::build_graph(bar, {});
  RatesOf<3> nodes(particles), cells(particles, 0, true);
  EXPECT_EQ(nodes->frequency({0.0447}), cells->frequency({0.0447, 0}));
  const double half = cells->frequency({0.0447, 0.5}), whole = cells->frequency({0.0447, 0.99}),
               none = nodes->frequency({0.0447});
  EXPECT_GT(whole, 1);
  EXPECT_LE(half * half, 1.02 * (none * none + whole * whole) / 2);
}

// Of a sum of two positive operators: no less than of either, no more than of both.
TEST(LargestRates, KnowTheLimitOfLeapfrogWithBothRates) {
  const auto graph = squares(24, 24);
  RatesOf<2> largest(graph);
  const double dt = 0.46, r = 0.535, omega = largest->frequency({r}), d = largest->dissipation(r),
               limit = largest->leapfrog_limit(dt, {r}, 1);
  EXPECT_GE(limit, 0.98 * std::max(dt * dt * omega * omega / 4, dt * d / 2));
  EXPECT_LE(limit, 1.02 * (dt * dt * omega * omega / 4 + dt * d / 2));
  EXPECT_NEAR(largest->leapfrog_limit(dt, {r}, 0), dt * dt * omega * omega / 4, 1e-12);
}

TEST(LargestRates, AreTheSameForEveryNumberOfThreads) {
  const auto graph = squares(48, 48);
  const auto rates = [&](int n) {
    parallel::set_threads(n);
    return std::pair{RatesOf<2>(graph)->dissipation(0.5),
                     RatesOf<2>(graph, 0.125)->frequency({0.5})};
  };
  const auto one = rates(1);
  EXPECT_EQ(rates(2), one);
  EXPECT_EQ(rates(3), one);
  parallel::set_threads(0);
}

// graph rate 2 c_p/h, omega that of the body, d 2 (c_p + c_s)/h, c_s/c_p = 0.535
TEST(DefaultCfl, IsThatOfTheFrequencyOnSquaresOrOfTheDissipation) {
  {
    const char* const name = "ssp-rk2";
    const double omega = RatesOf<2>(squares(16, 16))->frequency({0.535});
    const double expected = time::integrator_menu().at(name).default_dt_omega * 2 / omega;
    EXPECT_NEAR(cfl({}, name), expected, 0.02 * expected) << name;
  }
  EXPECT_NEAR(cfl({}, "ssp-rk3"), 0.8 * 2.5127 / 1.535, 0.02);
}

// c dt/h = 1 is the limit of leapfrog along one direction: both bounds are well below
TEST(DefaultCfl, StaysBelowTheLimitAlongOneDirection) {
  EXPECT_GT(cfl({"mesh.cells=[256,1]"}), 0.5);
  EXPECT_LT(cfl({"mesh.cells=[256,1]"}), 0.85);
  EXPECT_GT(cfl({"mesh.cells=[256,1]"}, "ssp-rk3"), 0.6 * 1.256);
  EXPECT_LT(cfl({"mesh.cells=[256,1]"}, "ssp-rk3"), 0.95 * 1.256);
}

TEST(DefaultCfl, FallsWithStrongerDissipationButDoesNotRiseWithWeaker) {
  EXPECT_NEAR(cfl({"scheme.dissipation=4"}), cfl({"scheme.dissipation=2"}) / 2, 1e-12);
  // dt d = 0.8 * 2 and 0.8 * 2.51
  const double d = 2 * 2 * 1.535 / 2;
  EXPECT_NEAR(cfl({"scheme.dissipation=2"}), 1.6 / d, 0.02);
  EXPECT_NEAR(cfl({"scheme.dissipation=2"}, "ssp-rk3"), 0.8 * 2.5127 / d, 0.02);
  EXPECT_GE(cfl({"scheme.dissipation=0"}), cfl({}));
  EXPECT_EQ(cfl({"scheme.dissipation=0"}, "ssp-rk2"), cfl({}, "ssp-rk2"));
}

// At rest both impedances are those of the speeds; the records of rows differ.
TEST(DefaultCfl, IsThatOfTheSameBodyForBothImpedances) {
  meshes::Mesh mesh =
      meshes::box(meshes::CellType::quadrilateral, {0, 0, 0}, {1, 1, 0}, {16, 16, 1});
  std::vector<std::int32_t> order(mesh.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  const auto graph = fvm::build_graph(meshes::renumbered(mesh, order), {});
  const auto first_step = [&](const std::string& impedance) {
    const cases::Case setup =
        cases::case_from_text(block, "block", {"scheme.impedance=" + impedance});
    auto solver = make_solver(setup, graph);
    EXPECT_EQ(solver->arrangement(), "rows");
    solver->step(1e6);
    return solver->time();
  };
  const double expected = first_step("isotropic");
  EXPECT_NEAR(first_step("exact"), expected, 1e-9 * expected);
}

TEST(DefaultCfl, KnowsTheRealExtentOfTheIntegrators) {
  EXPECT_NEAR(real_extent(time::integrator_menu().at("ssp-rk2")), 2, 2e-3);
  EXPECT_NEAR(real_extent(time::integrator_menu().at("ssp-rk3")), 2.5127, 2e-3);
  EXPECT_NEAR(real_extent(time::integrator_menu().at("ssp-rk43")), 5.1495, 2e-3);
}

}  // namespace
}  // namespace diptych::run
