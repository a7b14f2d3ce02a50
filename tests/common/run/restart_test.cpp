/// A run that goes on from a checkpoint is the run that never ended, to the last bit: state, rows
/// of the history, energies, steps. Over both methods, every integrator, branches, boundary
/// conditions, dimensions, precisions, arrangements, exact solutions, and threads that change in
/// between.

#include "common/base/error.hpp"
#include "common/io/checkpoint_file.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/run/observers/cell_watch.hpp"
#include "common/run/observers/energy_guard.hpp"
#include "common/run/observers/exact_comparison.hpp"
#include "common/run/observers/field_scales.hpp"
#include "common/run/observers/history.hpp"
#include "common/run/observers/step_probes.hpp"
#include "common/run/simulation.hpp"
#include "common/time/integrator.hpp"
#include "tests/common/io/scratch.hpp"
#include "tests/common/scheme/scenes.hpp"
#include "tests/trials.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <random>
#include <set>
#include <tuple>

namespace diptych::run {
namespace {

using testing::HasSubstr;
using tests::Scene;

/// What a run comes to.
struct Record {
  std::string hash;
  std::int64_t steps = 0;
  std::vector<std::string> lines;    ///< of history.csv and steps.csv
  std::vector<double> figures;       ///< audit, totals, error norms, scales
  std::vector<std::int64_t> checks;  ///< steps
  bool operator==(const Record&) const = default;
};

/// At which steps the body is looked at between outputs.
struct ChecksMade : Observer {
  std::vector<std::int64_t> steps;
  void at_check(const Check& check) override { steps.push_back(check.step.step); }
  void archive(algebra::Archive& archive) override { archive.integers("checks made", steps); }
};

/// A scene with the observers that keep a state of their own.
class Route {
 public:
  Route(const std::string& method,
        const std::string& text,
        const std::vector<std::string>& overrides,
        std::int64_t last_step = 0)
      : scene_(tests::scene_of(method, text, all(overrides, last_step))),
        probes_(scene_.setup.probes, scene_.graph, {}),
        cells_([this] {
          const algebra::Vec3 u = first_displacement();
          return LeastCell{1 + u[0], 0, 1, u};
        }),
        watch_([this](double) {
          return CellOutlook{{1 + first_displacement()[0], 0, 1}, 40};
        }),
        history_(*scene_.solver, probes_, cells_),
        steps_(*scene_.solver, probes_),
        exact_(scene_.setup,
               with_exact_survey(scene_),
               0,
               probes_,
               natural_sizes(scene_.setup, scene_.graph, scene_.solver->undeformed_speed())),
        scales_(scene_.graph),
        guard_(scene_.solver->balance(), 1e9, {1e9}, {1e-9}),
        simulation_(scene_.setup,
                    *scene_.solver,
                    {&cells_, &watch_, &history_, &steps_, &exact_, &scales_, &guard_, &checks_}) {}

  /// Goes on from the file.
  void load(const std::string& path) {
    io::CheckpointReader reader(path);
    simulation_.archive(reader);
    reader.finish();
  }
  /// To the end, or to the last step, with a checkpoint at that path at the end.
  void run(const std::string& path) {
    Checkpointing keeping;
    keeping.every = std::int64_t{1} << 40;
    keeping.write = [&] {
      io::CheckpointWriter writer(path);
      simulation_.archive(writer);
      writer.publish();
    };
    simulation_.keep(keeping);
    simulation_.run();
    EXPECT_FALSE(simulation_.breakdown()) << simulation_.breakdown()->what();
  }
  Record record() {
    Record record;
    record.hash = scene_.solver->state_hash(tests::natural_order(scene_.graph));
    record.steps = simulation_.totals().steps;
    record.checks = checks_.steps;
    for (const io::HistoryRow& row : history_.rows())
      record.lines.push_back(io::history_line(row));
    for (const io::StepRow& row : steps_.rows())
      record.lines.push_back(io::steps_line(row));
    const scheme::Audit& audit = scene_.solver->audit();
    const StepTotals& totals = simulation_.totals();
    record.figures = {audit.external_work,
                      audit.numerical_dissipation,
                      audit.viscous_dissipation,
                      audit.projection_work,
                      audit.impulse.linear.norm(),
                      audit.impulse.angular.norm(),
                      totals.dt_min,
                      totals.dt_max,
                      totals.least_J,
                      static_cast<double>(totals.rejected)};
    for (const auto& [field, norms] : exact_.errors().relative())
      record.figures.insert(record.figures.end(), {norms.l1, norms.l2, norms.linf});
    for (const auto& [field, norm] : scales_.largest())
      record.figures.push_back(norm);
    for (const io::HistoryColumn& column : exact_.columns())
      record.figures.insert(record.figures.end(), column.values.begin(), column.values.end());
    return record;
  }
  const Scene& scene() const { return scene_; }

 private:
  static const Solver& with_exact_survey(const Scene& scene) {
    Surveys surveys;
    if (ExactSurvey::is_for(scene.setup))
      surveys.push_back(std::make_unique<ExactSurvey>(scene.setup, *scene.solver, scene.graph));
    scene.solver->take(std::move(surveys));
    return *scene.solver;
  }
  algebra::Vec3 first_displacement() const {
    NodeReads all = scene_.solver->reads({});
    return scene_.solver->motion(all).u[0];
  }
  static std::vector<std::string> all(std::vector<std::string> overrides, std::int64_t last_step) {
    if (last_step > 0) overrides.push_back(fmt::format("time.max_steps={}", last_step));
    return overrides;
  }

  Scene scene_;
  Probes probes_;
  Cells cells_;
  CellWatch watch_;
  History history_;
  StepProbes steps_;
  ExactComparison exact_;
  FieldScales scales_;
  EnergyGuard guard_;
  ChecksMade checks_;
  Simulation simulation_;
};

/// Ended after each of these steps and gone on with, by another number of threads each time.
Record in_parts(const std::string& method,
                const std::string& text,
                const std::vector<std::string>& overrides,
                const std::vector<std::int64_t>& ends) {
  const test::Scratch folder;
  const std::string path = folder.path() + "/checkpoint.hdf";
  for (size_t part = 0; part <= ends.size(); ++part) {
    parallel::set_threads(part % 2 == 0 ? 1 : 2);
    Route route(method, text, overrides, part < ends.size() ? ends[part] : 0);
    if (part > 0) route.load(path);
    route.run(path);
    if (part == ends.size()) return route.record();
    EXPECT_EQ(route.record().steps, ends[part]) << "the run ended before";
  }
  return {};
}

Record whole(const std::string& method,
             const std::string& text,
             const std::vector<std::string>& overrides) {
  const test::Scratch folder;
  parallel::set_threads(1);
  Route route(method, text, overrides);
  route.run(folder.path() + "/checkpoint.hdf");
  return route.record();
}

/// Every route through these steps gives the same record.
void expect_same_bits(const std::string& method,
                      const std::string& text,
                      const std::vector<std::string>& overrides = {}) {
  const Record wanted = whole(method, text, overrides);
  ASSERT_GE(wanted.steps, 10) << "too few steps to end in between";
  const std::int64_t n = wanted.steps;
  std::vector<std::vector<std::int64_t>> routes{{1}, {n - 1}, {2, 3, n / 3, n / 2, 2 * n / 3}};
  for (const std::int64_t due : wanted.checks)
    routes.push_back({due});
  std::mt19937_64 random(static_cast<std::uint64_t>(n));
  tests::Trials trials("restarts");
  for (int k = 0; k < trials.n(1, 20); ++k) {  // chains of one to five random steps
    std::set<std::int64_t> ends;
    while (static_cast<int>(ends.size()) <= k % 5)
      ends.insert(1 + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n - 1)));
    routes.emplace_back(ends.begin(), ends.end());
  }
  for (const std::vector<std::int64_t>& ends : routes) {
    const Record found = in_parts(method, text, overrides, ends);
    trials.add(found.hash == wanted.hash && found.lines == wanted.lines &&
               found.figures == wanted.figures && found.checks == wanted.checks);
    EXPECT_EQ(found.hash, wanted.hash) << method << ", first end at step " << ends.front();
    EXPECT_EQ(found.steps, wanted.steps);
    EXPECT_EQ(found.lines, wanted.lines);
    EXPECT_EQ(found.figures, wanted.figures);
    EXPECT_EQ(found.checks, wanted.checks);
  }
}

std::string probes_in(int dimension) {
  return R"([[probe]]
name = "speed"
unit = "m/s"
kind = "mean"
quantity = "vx"
every_step = true
[[probe]]
name = "force"
unit = "N"
kind = "reaction"
group = "x_min"
direction = )" +
         std::string(dimension == 2 ? "[1, 0]" : "[1, 0, 0]") + "\n[output]\nframes = 3\n";
}

/// A block, moved at one end and pushed at the other by what changes with time.
std::string block(int dimension, int n_branches) {
  std::string text = "[mesh]\n";
  text += dimension == 2 ? "element = \"quadrilateral\"\nupper = [1, 1]\ncells = [7, 5]\n"
                         : "element = \"hexahedron\"\nupper = [1, 1, 1]\ncells = [3, 4, 3]\n";
  text +=
      "[material]\nmodel = \"mooney-rivlin\"\ndensity = 1100\nyoungs_modulus = 17e6\n"
      "poissons_ratio = 0.3\nzeta_ratio = 0.5\n";
  for (int k = 0; k < n_branches; ++k) {
    text += fmt::format("[[material.branch]]\nbeta_C = 0.5\ntau_C = {}e-3\n", k + 1);
    if (k != 1) text += "beta_G = 0.3\ntau_G = 2e-3\n";
  }
  const std::string z = dimension == 2 ? "" : ", 0";
  text += "[initial]\nvelocity = [\"9*y\", \"5*x*y\"" + z + "]\n";
  text += "[[boundary]]\ngroup = \"x_min\"\ntype = \"velocity\"\nvalue = [\"sin(300*t)\", 0" + z +
          "]\n[[boundary]]\ngroup = \"x_max\"\ntype = \"pressure\"\nvalue = \"1e5*sin(900*t)\"\n";
  return text + "[time]\nend = 0.012\ncfl = 0.5\n" + probes_in(dimension);
}

struct Setting {
  const char* method;
  std::string integrator;
  int dimension, n_branches;
};

void PrintTo(const Setting& setting, std::ostream* out) {
  *out << fmt::format("{} {} in {}-D with {} branches", setting.method, setting.integrator,
                      setting.dimension, setting.n_branches);
}

class Restart : public testing::TestWithParam<Setting> {};

TEST_P(Restart, HasTheBitsOfTheRunThatNeverEnded) {
  const auto& [method, integrator, dimension, n_branches] = GetParam();
  expect_same_bits(method, block(dimension, n_branches), {"time.integrator=" + integrator});
}

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (const char* method : {"sph", "fvm"}) {
    for (const std::string& integrator : time::integrator_menu().names()) {
      for (const int dimension : {2, 3}) {
        for (const int n_branches : {0, 1, 3})
          all.push_back({method, integrator, dimension, n_branches});
      }
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Restart, testing::ValuesIn(settings()), [](const auto& setting) {
  std::string name =
      fmt::format("{}_{}_{}d_{}_branches", setting.param.method, setting.param.integrator,
                  setting.param.dimension, setting.param.n_branches);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(RestartWith, EveryOptionOfTheScheme) {
  for (const char* method : {"sph", "fvm"}) {
    for (const std::vector<std::string>& overrides : std::vector<std::vector<std::string>>{
             {"scheme.precision=single"},
             {"scheme.precision=mixed", "time.integrator=leapfrog"},
             {"scheme.unknowns=F"},
             {"scheme.unknowns=FJ", "time.integrator=leapfrog"},
             {"scheme.impedance=exact"},
             {"scheme.reconstruction=objective"},
             {"scheme.reconstruction=objective", "time.integrator=leapfrog",
              "mesh.perturbation=0.2"},
             {"scheme.reconstruction=symmetric"},
             {"scheme.reconstruction=symmetric", "time.integrator=leapfrog",
              "mesh.perturbation=0.2"},
             {"scheme.face_correction=0.125", "scheme.limiter=venkatakrishnan"},
             {"scheme.face_correction=0.125", "time.integrator=leapfrog"},
             {"scheme.angular_momentum_projection=true"},
             {"scheme.volumes=cells", "time.integrator=leapfrog"},
             {"scheme.volumes=cells"},
             {"time.speeds=bound", "time.integrator=leapfrog", "mesh.element=tetrahedron"},
             {"time.speeds=linearised", "time.max_retries=0", "mesh.perturbation=0.2"}}) {
      SCOPED_TRACE(overrides.front());
      expect_same_bits(method, block(3, 1), overrides);
    }
  }
}

/// Thrown against a wall, which it leaves again; with steps that are rejected.
TEST(RestartWith, WallsAndRejectedSteps) {
  for (const auto& [method, integrator, speed] :
       {std::tuple("fvm", "ssp-rk3", 350), std::tuple("fvm", "leapfrog", 400)}) {
    const std::string text = fmt::format("[parameters]\nspeed = {}\n", speed) + R"([mesh]
element = "hexahedron"
cells = [6, 6, 6]
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.45
[[material.branch]]
beta_C = 0.5
tau_C = 2e-3
[initial]
velocity = [0, 0, "-speed"]
[[boundary]]
group = "z_min"
type = "rigid-wall"
point = [0, 0, -0.01]
normal = [0, 0, 1]
[[boundary]]
group = "x_min"
type = "symmetry"
[[boundary]]
group = "z_max"
type = "traction"
value = [0, 0, 1e4]
[load]
body_force = [0, 0, -1e4]
[time]
end = 1.5e-3
[scheme]
volumes = "nodes"
[fvm]
stencil = "edge"
)" + probes_in(3);
    std::vector<std::string> overrides{std::string("time.integrator=") + integrator};
    if (speed == 400) overrides.insert(overrides.end(), {"time.end=5e-4", "output.frames=10"});
    EXPECT_GT(whole(method, text, overrides).figures[9], 0) << "no step is rejected";
    expect_same_bits(method, text, overrides);
  }
}

TEST(RestartWith, ManufacturedSolutionsWhoseLoadsDependOnThePast) {
  const std::string text = R"toml([mesh]
element = "quadrilateral"
upper = [1, 1]
cells = [6, 6]
[material]
model = "mooney-rivlin"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
zeta_ratio = 0.5
[[material.branch]]
beta_C = 0.5
tau_C = 2e-3
beta_G = 0.5
tau_G = 1e-3
[manufactured]
displacement = ["0.05*sin(3*x)*sin(600*t)", "0.05*cos(3*y)*sin(600*t)"]
[[boundary]]
group = ["x_min", "x_max"]
type = "velocity"
value = "manufactured"
[[boundary]]
group = ["y_min", "y_max"]
type = "traction"
value = "manufactured"
[time]
end = 5e-3
cfl = 0.5
)toml" + probes_in(2);
  for (const char* integrator : {"ssp-rk3", "leapfrog"})
    expect_same_bits("sph", text, {std::string("time.integrator=") + integrator});
}

TEST(RestartWith, EndsWhereGuardsWereToLook) {
  const std::vector<std::string> settings{"output.frames=1", "time.cfl=0.1", "time.end=0.006"};
  for (const char* method : {"sph", "fvm"}) {
    ASSERT_GE(whole(method, block(2, 0), settings).checks.size(), 1u) << method;
    expect_same_bits(method, block(2, 0), settings);
  }
}

TEST(RestartWith, AnotherEndAndOtherInstantsOfOutput) {
  const test::Scratch folder;
  const std::string path = folder.path() + "/checkpoint.hdf";
  Route first("fvm", block(2, 1), {});
  first.run(path);
  Route second("fvm", block(2, 1), {"time.end=0.02", "output.frames=8"});
  second.load(path);
  second.run(path);
  const auto& rows = second.record().lines;
  EXPECT_GT(second.record().steps, first.record().steps);
  // of before, and then those of eighths of the new end that lie behind it
  const std::vector<double> wanted{0, 0.004, 0.008, 0.012, 0.0125, 0.015, 0.0175, 0.02};
  for (size_t k = 0; k < wanted.size(); ++k)
    EXPECT_NEAR(std::stod(rows[k]), wanted[k], 1e-15);
  Route third("fvm", block(2, 1), {"time.end=0.01"});
  try {
    third.load(path);
    FAIL() << "the end lies before the state";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("time.end = 0.01 s is before the state"));
  }
}

TEST(RestartWith, AnotherSchemeIsRefused) {
  const test::Scratch folder;
  const std::string path = folder.path() + "/checkpoint.hdf";
  Route first("fvm", block(2, 1), {});
  first.run(path);
  for (const char* other : {"scheme.unknowns=F", "mesh.cells=[6, 5]", "scheme.impedance=exact"}) {
    Route second("fvm", block(2, 1), {other});
    EXPECT_THROW(second.load(path), base::InputError) << other;
  }
}

}  // namespace
}  // namespace diptych::run
