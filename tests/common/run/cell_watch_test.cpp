/// The step that turns a cell inside out is taken back, whatever the output times, by few looks.

#include "common/run/observers/cell_watch.hpp"

#include "common/run/observers/history.hpp"
#include "common/run/simulation.hpp"
#include "tests/common/run/free_cube.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::HasSubstr;
using tests::free_cube;

/// The cube, whose only cell comes to nothing when a node has moved by `room`.
struct Watched {
  Watched(const std::vector<std::string>& overrides, double room)
      : scene(tests::scene_of("fvm", free_cube, overrides)),
        probes(scene.setup.probes, scene.graph, {}),
        cells(
            [this, room] {
              ++n_looks_at_outputs;
              return cell_of(motion().u, room);
            },
            [this](std::int64_t step) { return watch.seen(step); }),
        watch([this, room](double dt) {
          ++n_looks;
          const Motion moving = motion();
          std::vector<algebra::Vec3> next = moving.u;
          for (size_t a = 0; a < next.size(); ++a)
            next[a] += dt * moving.v[a];
          const LeastCell now = cell_of(moving.u, room);
          const double lost = now.J - cell_of(next, room).J;
          return CellOutlook{now, lost > 0 ? now.J / lost : 1e300};
        }),
        history(*scene.solver, probes, cells),
        simulation(scene.setup, *scene.solver, {&cells, &watch, &history}) {}

  static LeastCell cell_of(std::span<const algebra::Vec3> u, double room) {
    double most = 0;
    for (const algebra::Vec3& of_node : u)
      most = std::max(most, of_node.norm());
    return {1 - most / room, most >= room ? 1 : 0, 1};
  }
  Motion motion() const {
    NodeReads all = scene.solver->reads({});
    return scene.solver->motion(all);
  }
  std::string hash() { return scene.solver->state_hash(tests::natural_order(scene.graph)); }

  tests::Scene scene;
  Probes probes;
  std::int64_t n_looks = 0, n_looks_at_outputs = 0;
  Cells cells;
  CellWatch watch;
  History history;
  Simulation simulation;
};

TEST(CellWatch, TakesTheStepBackThatTurnsACell) {
  for (const std::string integrator : {"leapfrog", "ssp-rk3"}) {
    SCOPED_TRACE(integrator);
    const std::vector<std::string> overrides{"time.integrator=\"" + integrator + "\"",
                                             "time.cfl=0.1", "output.frames=2"};
    Watched run(overrides, 0.011);  // between the outputs
    EXPECT_EQ(run.simulation.run(), Ending::breakdown);
    const StepTotals& totals = run.simulation.totals();
    EXPECT_THAT(run.simulation.breakdown()->what(),
                HasSubstr(fmt::format("1 of 1 cells are inside out, step {}, ", totals.begun)));
    EXPECT_EQ(totals.begun, totals.steps + 1);
    const io::HistoryRow& last = run.history.rows().back();
    EXPECT_EQ(last.step, totals.steps);
    EXPECT_GT(last.least_cell_J, 0) << "the body is whole";
    EXPECT_LT(last.least_cell_J, 2.0 / static_cast<double>(totals.steps))
        << "a step before it is not";
    EXPECT_EQ(run.simulation.take_state().time, last.time);

    std::vector<std::string> ended = overrides;
    ended.push_back(fmt::format("time.max_steps={}", totals.steps));
    Watched other(ended, 1);
    EXPECT_EQ(other.simulation.run(), Ending::step_limit);
    EXPECT_EQ(run.hash(), other.hash()) << "nothing is left of the step";
  }
}

TEST(CellWatch, LeavesTheBodyWhereNoStepIsTakenBack) {
  Watched run({"time.cfl=0.1", "output.frames=2", "time.max_retries=0"}, 0.011);
  EXPECT_EQ(run.simulation.run(), Ending::breakdown);
  EXPECT_EQ(run.simulation.totals().begun, run.simulation.totals().steps);
  EXPECT_LE(run.history.rows().back().least_cell_J, 0);
}

TEST(CellWatch, LooksSeldomWhereNoCellNearsZero) {
  Watched run({"time.cfl=0.1", "output.frames=2"}, 10);
  EXPECT_EQ(run.simulation.run(), Ending::done);
  EXPECT_EQ(run.n_looks_at_outputs, 1) << "at t = 0; the others are known of the watch";
  EXPECT_LE(run.n_looks, 4 + run.simulation.totals().steps / CellWatch::period);
  EXPECT_GE(run.n_looks, run.simulation.totals().steps / CellWatch::period);
}

}  // namespace
}  // namespace diptych::run
