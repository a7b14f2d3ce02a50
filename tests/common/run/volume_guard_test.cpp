/// Runs in which J of the nodes has left the volumes that carry the pressure are stopped, sound
/// ones are not.

#include "common/run/observers/volume_guard.hpp"

#include "common/base/error.hpp"
#include "common/io/checkpoint_file.hpp"
#include "common/run/simulation.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <limits>

namespace diptych::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A body of rubber between two clamps, one of which is drawn away to some times its length.
std::string pulled(const std::string& mesh, const std::string& dir, const std::string& velocity) {
  return "[mesh]\n" + mesh + R"(
[material]
model = "mooney-rivlin"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.49
zeta_ratio = 0.5
[[boundary]]
group = ")" +
         dir + R"(_min"
type = "fixed"
[[boundary]]
group = ")" +
         dir + R"(_max"
type = "velocity"
value = )" +
         velocity + R"(
[time]
end = 0.1
[output]
frames = 20
)";
}
const std::string cube = pulled("cells = [3, 3, 3]", "z", "[0, 0, 20]");
const std::string square = pulled("element = \"quadrilateral\"\ncells = [3, 3]", "y", "[0, 20]");

/// How a run ends under a guard, and what it breaks down with.
struct Outcome {
  Ending ending;
  std::string message;
  std::optional<std::int64_t> node;
  double time;
  std::optional<std::string> notice;
};

Outcome outcome(const std::string& method,
                const std::string& text,
                double threshold,
                const std::vector<std::string>& overrides = {}) {
  tests::Scene scene = tests::scene_of(method, text, overrides);
  VolumeGuard guard(*scene.solver, threshold);
  Simulation simulation(scene.setup, *scene.solver, {&guard});
  Outcome outcome{simulation.run(), "", {}, scene.solver->time(), guard.notice()};
  if (simulation.breakdown()) {
    outcome.message = simulation.breakdown()->what();
    outcome.node = simulation.breakdown()->node();
  }
  return outcome;
}

// Lines of four nodes and one-sided gradients of SPH differ by third derivatives: beside a clamp
// the stretch of nodes comes to nothing at 2.5 times the length where lines keep the volume.
TEST(VolumeGuard, StopsAPulledBodyWhoseNodesLeaveTheVolumeOfLines) {
  for (const std::string& text : {cube, square}) {
    const Outcome stopped = outcome("sph", text, 0.2);
    EXPECT_EQ(stopped.ending, Ending::breakdown);
    EXPECT_LT(stopped.time, 0.08) << "before 2.6 times its length";
    EXPECT_THAT(
        stopped.message,
        AllOf(HasSubstr("J of the nodes has left the volumes that carry the pressure, by 0.2"),
              HasSubstr("bound 0.2: farthest at node "), HasSubstr(", step "),
              HasSubstr("time 0.0"), HasSubstr("--level"), HasSubstr("scheme.volumes = \"nodes\""),
              HasSubstr("guards.volumes_apart")));
    EXPECT_TRUE(stopped.node);
    EXPECT_FALSE(stopped.notice) << "the breakdown says it";
  }
}

TEST(VolumeGuard, LetsPassWhatNodesCarryAndFinerMeshes) {
  for (const std::string& text : {cube, square}) {
    for (const Outcome& passed :
         {outcome("fvm", text, 1e-300), outcome("sph", text, 1e-300, {"scheme.volumes=nodes"})}) {
      EXPECT_EQ(passed.ending, Ending::done) << passed.message;
      EXPECT_FALSE(passed.notice);
    }
  }
  const std::string cells = "mesh.cells=[12, 12]";
  EXPECT_EQ(outcome("sph", square, 0.1, {cells}).ending, Ending::done);
}

TEST(VolumeGuard, TellsOfWhatComesNearTheBound) {
  const Outcome near = outcome("sph", square, 0.2, {"time.end=0.02"});
  EXPECT_EQ(near.ending, Ending::done) << near.message;
  ASSERT_TRUE(near.notice);
  EXPECT_THAT(*near.notice, AllOf(HasSubstr("of the body's volume apart (at 0.02 s)"),
                                  HasSubstr("--level"), HasSubstr("scheme.volumes")));
  EXPECT_FALSE(outcome("sph", square, 0.2, {"time.end=0.004"}).notice);
}

/// Of a state as the fields of the nodes have it.
double apart_by_fields(const tests::Scene& scene) {
  const Snapshot s = scene.solver->snapshot();
  double apart = 0, carried = 0;
  for (size_t a = 0; a < s.F.size(); ++a) {
    apart += scene.graph.Omega[a] * std::abs(s.F[a].determinant() - s.J[a]);
    carried += scene.graph.Omega[a] * s.J[a];
  }
  return apart / carried;
}

TEST(Balance, HasHowFarVolumesAndNodesAreApart) {
  for (const std::string& text : {cube, square}) {
    for (const char* volumes : {"lines", "cells"}) {
      const bool on_cells = std::string(volumes) == "cells";
      const tests::Scene scene = tests::scene_of(
          "sph", text,
          {std::string("scheme.volumes=") + volumes,
           std::string("sph.gradient=") + (on_cells ? "corrected" : "sbp"), "time.cfl=0.3"});
      EXPECT_LT(scene.solver->balance().volumes_apart(), 1e-14);
      tests::run_to(*scene.solver, 0.01);
      const double apart = scene.solver->balance().volumes_apart();
      EXPECT_GT(apart, 1e-3);
      EXPECT_NEAR(apart, apart_by_fields(scene), 1e-12 * apart) << volumes;
    }
  }
  const tests::Scene nodes = tests::scene_of("fvm", square);
  tests::run_to(*nodes.solver, 0.01);
  EXPECT_EQ(nodes.solver->balance().volumes_apart(), 0);
}

TEST(VolumeGuard, IsNotMisledByStatesThatAreNoBodies) {
  const tests::Scene scene = tests::scene_of("sph", square);
  VolumeGuard guard(*scene.solver, 0.2);
  const auto judge = [&](double carried, double apart) {
    scheme::Balance now;
    now.carried_volume = carried;
    now.volume_apart = apart;
    guard.at_check({StepReport{}, now, scheme::Audit{}});
  };
  EXPECT_NO_THROW(judge(0, 0));
  EXPECT_NO_THROW(judge(10, 1.9));
  EXPECT_THROW(judge(10, 2.1), base::BreakdownError);
  EXPECT_THROW(judge(-10, 0.1), base::BreakdownError);
  EXPECT_THROW(judge(1, std::numeric_limits<double>::quiet_NaN()), base::BreakdownError);
}

TEST(VolumeGuard, GoesOnFromACheckpointWithWhatItHasSeen) {
  const tests::Scene scene = tests::scene_of("sph", square);
  const std::string file =
      (std::filesystem::path(testing::TempDir()) / "diptych_volume_guard.hdf").string();
  scheme::Balance now;
  now.carried_volume = 1;
  now.volume_apart = 0.125;
  StepReport step;
  step.time = 0.5;
  VolumeGuard guard(*scene.solver, 0.2), later(*scene.solver, 0.2);
  guard.at_check({step, now, scheme::Audit{}});
  {
    io::CheckpointWriter writer(file);
    guard.archive(writer);
    writer.publish();
  }
  io::CheckpointReader reader(file);
  later.archive(reader);
  reader.finish();
  now.volume_apart = 0.1;
  later.at_check({step, now, scheme::Audit{}});
  ASSERT_TRUE(later.notice());
  EXPECT_EQ(*later.notice(), *guard.notice());
  EXPECT_THAT(*later.notice(), HasSubstr("up to 0.12 of the body's volume apart (at 0.5 s)"));
}

}  // namespace
}  // namespace diptych::run
