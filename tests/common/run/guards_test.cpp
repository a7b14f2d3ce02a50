/// Runs that are no solution any more are stopped, with what they had found until then; sound ones
/// are not.

#include "common/run/observers/cell_guard.hpp"
#include "common/run/observers/energy_guard.hpp"
#include "common/run/simulation.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <cmath>
#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A free cube that is thrown at itself, slowly.
const std::string free_cube = R"([mesh]
element = "hexahedron"
cells = [4, 4, 4]
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
[initial]
velocity = ["-1*x", 0, 0]
[time]
end = 0.08
integrator = "ssp-rk2"
[output]
frames = 10
)";

/// A run of the cube with guards, and with `inverted` cells of 64 from the fourth output on.
struct Guarded {
  Guarded(const std::string& method,
          const std::vector<std::string>& overrides,
          std::int64_t inverted = 0,
          double least_energy = 0)
      : scene(tests::scene_of(method, free_cube, overrides)),
        probes(scene.setup.probes, scene.graph),
        cells([this, inverted](std::span<const algebra::Vec3>) {
          return ++n_outputs > 3 && inverted > 0 ? LeastCell{-0.5, inverted, 64, {0.25, 0.5, 0.75}}
                                                 : LeastCell{1, 0, 64};
        }),
        history(*scene.solver, probes, cells),
        energy_guard(history, scene.setup.guards.energy_residual, least_energy),
        cell_guard(cells) {}

  /// @param guards_cells  as guards.inverted_cells = "stop"
  Ending run(bool guards_cells = true) {
    std::vector<Observer*> observers{&cells, &history, &energy_guard};
    if (guards_cells) observers.push_back(&cell_guard);
    Simulation simulation(scene.setup, *scene.solver, observers);
    const Ending ending = simulation.run();
    if (simulation.breakdown()) message = simulation.breakdown()->what();
    return ending;
  }

  tests::Scene scene;
  Probes probes;
  int n_outputs = 0;
  Cells cells;
  History history;
  EnergyGuard energy_guard;
  CellGuard cell_guard;
  std::string message;
};

TEST(EnergyGuard, StopsAnUnstableRunBeforeAnyNodeShowsIt) {
  for (const char* method : {"sph", "fvm"}) {
    SCOPED_TRACE(method);
    Guarded run(method, {"time.cfl=3"});
    EXPECT_EQ(run.run(), Ending::breakdown);
    EXPECT_THAT(run.message, AllOf(HasSubstr("energy budget"), HasSubstr("bound 0.1, step "),
                                   HasSubstr("time.cfl"), HasSubstr("guards.energy_residual")));
    const io::HistoryRow& last = run.history.rows().back();
    EXPECT_GT(last.energy.relative_residual, 0.1) << "the row that it stopped at is kept";
    EXPECT_TRUE(std::isfinite(last.energy.kinetic));
    EXPECT_GT(last.min_jacobian, 0.9) << "strains are some hundredths yet";
  }
}

TEST(EnergyGuard, LetsAStableRunPass) {
  for (const char* method : {"sph", "fvm"}) {
    SCOPED_TRACE(method);
    Guarded run(method, {"time.cfl=0.5"});
    EXPECT_EQ(run.run(), Ending::done) << run.message;
  }
}

TEST(EnergyGuard, HasTheBoundOfTheCase) {
  // the residual of the second-order scheme is 1e-3, of the order of dt^2
  Guarded run("fvm", {"time.cfl=0.5", "guards.energy_residual=1e-5"});
  EXPECT_EQ(run.run(), Ending::breakdown);
  EXPECT_THAT(run.message, HasSubstr("bound 1e-05"));
}

TEST(EnergyGuard, DoesNotJudgeRounding) {
  // all that the cube ever has is 190 J
  Guarded run("fvm", {"time.cfl=0.5", "guards.energy_residual=1e-5"}, 0, 1e3);
  EXPECT_EQ(run.run(), Ending::done) << run.message;
}

TEST(CellGuard, StopsWhereACellIsInsideOutAndKeepsTheRow) {
  Guarded run("fvm", {"time.cfl=0.5"}, 1);
  EXPECT_EQ(run.run(), Ending::breakdown);
  EXPECT_THAT(run.message, AllOf(HasSubstr("1 of 64 cells"), HasSubstr("time 0.024 s"),
                                 HasSubstr("(0.25, 0.5, 0.75)"), HasSubstr("sign-preserving"),
                                 HasSubstr("guards.inverted_cells")));
  ASSERT_EQ(run.history.rows().size(), 4u);
  EXPECT_EQ(run.history.rows().back().least_cell_J, -0.5);
}

TEST(CellGuard, IsNotThereWhereTheCaseWarns) {
  Guarded run("fvm", {"time.cfl=0.5"}, 1);
  EXPECT_EQ(run.run(false), Ending::done) << run.message;
  io::RunSummary summary;
  run.cells.fill(summary);
  EXPECT_EQ(summary.most_inverted_cells, 1);
  EXPECT_NEAR(summary.inverted_from.value_or(0), 0.024, 1e-15) << "the output time, to rounding";
}

}  // namespace
}  // namespace diptych::run
