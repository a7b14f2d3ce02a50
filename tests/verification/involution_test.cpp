/// H and J as unknowns of their own (18c,d): how far they leave cof F and det F, how that converges
/// in time, that the run logs it, and that the unknowns F, FJ, FHJ give one answer within it.

#include "benchmarks/run/run_case.hpp"
#include "tests/verification/case_scene.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

using tests::Scene;
using tests::text_of;

class Involutions : public testing::TestWithParam<const char*> {
 protected:
  /// The cube of scenes.hpp, strained, after n equal steps.
  std::unique_ptr<Scene> after(int n,
                               const std::string& integrator,
                               const std::string& unknowns) const {
    parallel::set_threads(1);
    auto scene = std::make_unique<Scene>(
        GetParam(), cases::case_from_text(tests::spinning_cube, "scene",
                                          {tests::any_step, text_of("time.integrator", integrator),
                                           text_of("scheme.unknowns", unknowns)}));
    tests::make_steps(*scene->solver, 1e-3, n);
    return scene;
  }
};
INSTANTIATE_TEST_SUITE_P(Both, Involutions, testing::Values("sph", "fvm"));

TEST_P(Involutions, DriftFallsAtTheOrderOfTheIntegrator) {
  for (const auto& [integrator, order] : {std::pair{"ssp-rk2", 1.9}, std::pair{"ssp-rk3", 2.8}}) {
    const auto coarse = after(16, integrator, "FHJ")->solver->balance();
    const auto fine = after(32, integrator, "FHJ")->solver->balance();
    EXPECT_GT(fine.involution_H, 1e-12) << "nothing to converge: the test tests nothing";
    EXPECT_GE(std::log2(coarse.involution_H / fine.involution_H), order) << integrator;
    EXPECT_GE(std::log2(coarse.involution_J / fine.involution_J), order) << integrator;
    EXPECT_EQ(after(16, integrator, "F")->solver->balance().involution_H, 0);
    EXPECT_EQ(after(16, integrator, "FJ")->solver->balance().involution_H, 0);
    EXPECT_GT(after(16, integrator, "FJ")->solver->balance().involution_J, 0);
  }
  // leapfrog moves H and J by the exact polynomial of a constant rate: rounding only
  const auto exact = after(16, "leapfrog", "FHJ")->solver->balance();
  EXPECT_LE(exact.involution_H, 1e-13);
  EXPECT_LE(exact.involution_J, 1e-13);
}

/// Largest distance of F and of P between two sets of unknowns.
std::pair<double, double> gap(const Scene& one, const Scene& other) {
  const auto a = one.solver->snapshot(), b = other.solver->snapshot();
  double F = 0, P = 0;
  for (size_t k = 0; k < a.F.size(); ++k) {
    F = std::max(F, (a.F[k] - b.F[k]).norm());
    P = std::max(P, (a.P[k] - b.P[k]).norm());
  }
  return {F, P};
}

// The drift loads the body with the stress of its own size, about K (H - cof F): the answers differ
// by a multiple of it, and the more so the stiffer the body is in volume (nu = 0.45).
TEST_P(Involutions, UnknownsGiveOneAnswerUpToTheDrift) {
  for (const auto& [integrator, order] : {std::pair{"ssp-rk2", 1.9}, std::pair{"ssp-rk3", 2.8}}) {
    const auto coarse = after(16, integrator, "FHJ"), fine = after(32, integrator, "FHJ");
    const auto balance = fine->solver->balance();
    const double drift = std::max(balance.involution_H, balance.involution_J);
    for (const char* unknowns : {"F", "FJ"}) {
      const auto fewer = after(32, integrator, unknowns);
      EXPECT_LT(fewer->solver->unknowns_per_node(), fine->solver->unknowns_per_node());
      const auto [F_coarse, P_coarse] = gap(*after(16, integrator, unknowns), *coarse);
      const auto [F, P] = gap(*fewer, *fine);
      EXPECT_GE(std::log2(F_coarse / F), order) << integrator << ' ' << unknowns;
      EXPECT_GE(std::log2(P_coarse / P), order) << integrator << ' ' << unknowns;
      EXPECT_LE(F, 60 * drift) << integrator << ' ' << unknowns;
    }
  }
  for (const char* unknowns : {"F", "FJ"}) {
    const auto [F, P] = gap(*after(32, "leapfrog", unknowns), *after(32, "leapfrog", "FHJ"));
    EXPECT_LE(F, 1e-12) << unknowns;
    EXPECT_LE(P, 1e-11 * 17e6) << unknowns;
  }
}

TEST_P(Involutions, DriftIsInHistoryAndSummary) {
  harness::RunOptions options;
  options.method = GetParam();
  options.threads = 1;
  options.quiet = true;
  const auto result = run_case(
      cases::read_case(harness::find_case("spinning-cube"),
                       {"time.integrator=\"ssp-rk3\"", "mesh.cells=[3, 3, 3]", "output.frames=2"}),
      options);
  EXPECT_EQ(result.history.front().involution_H, 0);
  EXPECT_GT(result.history.back().involution_H, 1e-9);
  EXPECT_LT(result.history.back().involution_H, 1e-2);
  EXPECT_GT(result.history.back().involution_J, 1e-9);
  EXPECT_GE(result.summary.involution_H, result.history.back().involution_H);
  EXPECT_GE(result.summary.involution_J, result.history.back().involution_J);
}

}  // namespace
}  // namespace diptych
