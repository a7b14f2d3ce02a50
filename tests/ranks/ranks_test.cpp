/// Runs among ranks have the bits of a run of one process: state and histories, for both methods,
/// rows and runs of pairs, both precisions, and all that ranks tell each other of.

#include "tests/command_line/frames.hpp"
#include "tests/command_line/program.hpp"
#include "tests/trials.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <random>
#include <regex>

namespace diptych::tests {
namespace {

using testing::HasSubstr;

const std::string mpirun =
    "export OMP_WAIT_POLICY=passive; mpirun --oversubscribe --allow-run-as-root --bind-to none ";

/// A case with what tests change by --set; 1331 nodes, six chunks of them.
const std::string cube = R"toml(title = "Cube among ranks"
[mesh]
element = "hexahedron"
lower = [0, 0, 0]
upper = [1, 1, 1]
cells = [10, 10, 10]
[material]
model = "mooney-rivlin"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
zeta_ratio = 0.5
[initial]
velocity = ["20*y*z", "-30*x", "10*sin(3*x)"]
[time]
end = 5e-3
max_steps = 12
[output]
frames = 40
fields = false
)toml";
const std::string held = R"toml([[boundary]]
group = "x_min"
type = "fixed"
[[boundary]]
group = "x_max"
type = "traction"
value = ["1e5*sin(500*t)", 0, "2e5*y"]
)toml";
const std::string branches = R"toml([[material.branch]]
beta_C = 0.5
tau_C = 1e-3
beta_G = 0.5
tau_G = 2e-3
)toml";
const std::string probes = R"toml([[probe]]
name = "corner"
unit = "m"
kind = "point"
at = [1, 1, 1]
quantity = "ux"
every_step = true
[[probe]]
name = "support"
unit = "N"
kind = "reaction"
group = "x_min"
direction = [1, 0, 0]
)toml";
const std::string plane = R"toml(title = "Square among ranks"
[mesh]
element = "quadrilateral"
lower = [0, 0]
upper = [0.1, 0.1]
cells = [36, 36]
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 1e6
poissons_ratio = 0.4
[time]
end = 2e-2
max_steps = 30
[output]
frames = 200
fields = false
)toml";

struct Scene {
  const char* name;
  std::string text;
  std::string options;  ///< of the command line
};
std::ostream& operator<<(std::ostream& to, const Scene& scene) {
  return to << scene.name;
}

std::vector<Scene> scenes() {
  const std::string wall = R"toml([initial]
velocity = ["-20 + 100*y", 3]
[[boundary]]
group = "x_min"
type = "rigid-wall"
point = [-1e-4, 0]
normal = [1, 0]
[[boundary]]
group = "y_min"
type = "symmetry"
)toml";
  const std::string blown = R"toml([initial]
velocity = ["30*y", 0]
[[boundary]]
group = "x_max"
type = "pressure"
value = "1e4*t/1e-3"
[[boundary]]
group = "x_min"
type = "velocity"
value = ["sin(1000*t)", 0]
)toml";
  const std::string pressed = " --set material.poissons_ratio=0.49";
  return {
      {"HexahedraHeld", cube + held + probes, "--set output.fields=true"},
      {"TetrahedraInSinglePrecision", cube + held,
       "--set mesh.element=tetrahedron --set scheme.precision=single"},
      {"LeapfrogWithBranchesAndProjection", cube + branches,
       "--set time.integrator=leapfrog --set scheme.angular_momentum_projection=true"},
      {"MovedNodesWithLimiterAndFaceCorrection", cube + branches + held,
       "--set mesh.perturbation=0.2 --set scheme.limiter=venkatakrishnan --set "
       "scheme.face_correction=1/6 --set time.integrator=ssp-rk3"},
      {"VolumesOfCells", cube + held,
       "--set scheme.volumes=cells --set output.fields=true" + pressed},
      {"VolumesOfCellsLeapfrog", cube + held,
       "--set mesh.element=tetrahedron --set time.integrator=leapfrog --set scheme.volumes=cells" +
           pressed},
      {"VolumesOfLines", cube + held, "--set sph.gradient=sbp" + pressed},
      {"ExactImpedance", cube, "--set scheme.impedance=exact --set scheme.unknowns=F"},
      {"ObjectiveReconstruction", cube + branches, "--set scheme.reconstruction=objective"},
      {"ObjectiveReconstructionOnMovedNodes", cube + held,
       "--set scheme.reconstruction=objective --set mesh.perturbation=0.2 --set "
       "time.integrator=leapfrog --set scheme.limiter=sign-preserving"},
      {"SymmetricReconstruction", cube + branches, "--set scheme.reconstruction=symmetric"},
      {"SymmetricReconstructionOnMovedNodes", cube + held,
       "--set scheme.reconstruction=symmetric --set mesh.perturbation=0.2 --set "
       "time.integrator=leapfrog"},
      {"RigidWall", plane + wall, "--set time.integrator=leapfrog"},
      {"RigidWallInStages", plane + wall, ""},
      {"PressureAndVelocity", plane + blown, "--set scheme.volumes=cells"},
  };
}

/// What may differ: times of the clock, and how it was run.
std::string hash_in(const std::filesystem::path& run) {
  const std::string text = text_of(run / "summary.json");
  std::smatch found;
  return std::regex_search(text, found, std::regex(R"re("state_hash": "(\w+)")re")) ? found[1].str()
                                                                                    : "none";
}

class Ranks : public testing::TestWithParam<Scene> {
 protected:
  /// Runs the case on n ranks, 0: without mpirun, to a folder of that name.
  /// @param poisoned  what ranks give back is set to what is no number (common/parallel/pages.hpp)
  void run(int n, int threads = 1, const std::string& more = "", bool poisoned = true) const {
    const std::string start =
        n == 0 ? ""
               : std::string(poisoned ? "export DIPTYCH_RANK_MEMORY=poisoned; " : "") + mpirun +
                     "-n " + std::to_string(n) + " ";
    const Outcome outcome = shell(
        folder_, start + "$diptych run case.toml --quiet --threads " + std::to_string(threads) +
                     " --out " + std::to_string(n) + " " + GetParam().options + " " + more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  }
  void expect_same(const std::string& one, const std::string& other) const {
    for (const char* method : {"sph", "fvm"}) {
      const auto a = folder_.path() / one / method, b = folder_.path() / other / method;
      EXPECT_NE(hash_in(a), "none");
      EXPECT_EQ(hash_in(a), hash_in(b)) << method;
      EXPECT_EQ(text_of(a / "history.csv"), text_of(b / "history.csv")) << method;
      EXPECT_EQ(text_of(a / "steps.csv"), text_of(b / "steps.csv")) << method;
      const auto series = a / "run.hdf.series";
      ASSERT_EQ(std::filesystem::exists(series), std::filesystem::exists(b / "run.hdf.series"));
      if (std::filesystem::exists(series)) expect_same_frames(a, b);
    }
  }
  Folder folder_;
};

TEST_P(Ranks, HaveTheBitsOfOneProcess) {
  folder_.write("case.toml", GetParam().text);
  run(0);
  for (const int n : {2, 5}) {
    run(n, 1, n == 2 ? "--partition slab" : "", n != 2);
    expect_same("0", std::to_string(n));
  }
}
INSTANTIATE_TEST_SUITE_P(OfScenes, Ranks, testing::ValuesIn(scenes()), [](const auto& tested) {
  return tested.param.name;
});

/// Six chunks among seven ranks: the last one has nothing to work.
class MoreRanksThanChunks : public Ranks {};
TEST_P(MoreRanksThanChunks, HaveTheBitsOfOneProcess) {
  folder_.write("case.toml", GetParam().text);
  run(0);
  run(7);
  expect_same("0", "7");
}
INSTANTIATE_TEST_SUITE_P(OfScenes,
                         MoreRanksThanChunks,
                         testing::Values(Scene{"Held", cube + branches + held,
                                               "--set time.max_steps=5"},
                                         Scene{"Plane", plane, "--set time.max_steps=5"}),
                         [](const auto& tested) { return tested.param.name; });

/// A mesh of a file: rows.
class RanksOnRows : public Ranks {};
TEST_P(RanksOnRows, HaveTheBitsOfOneProcess) {
  folder_.write("case.toml", GetParam().text);
  folder_.write("disc.geo",
                "SetFactory(\"OpenCASCADE\");\nDefineConstant[h = 0.01];\n"
                "Disk(1) = {0, 0, 0, 0.05};\nMesh.MeshSizeMax = h;\n"
                "Physical Surface(\"body\") = {1};\nPhysical Curve(\"rim\") = {1};\n");
  run(0);
  EXPECT_THAT(text_of(folder_.path() / "0/sph/summary.json"),
              HasSubstr("\"arrangement\": \"rows\""));
  for (const int n : {2, 3}) {
    run(n, n - 1, n == 3 ? "--partition bisection" : "");
    expect_same("0", std::to_string(n));
  }
}
const std::string disc = R"toml(title = "Disc among ranks"
[mesh]
element = "triangle"
file = "disc.geo"
size = 2.5e-3
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 1e6
poissons_ratio = 0.45
[initial]
velocity = ["-5 + 100*y", "20*x"]
[[boundary]]
group = "rim"
type = "rigid-wall"
point = [-0.0502, 0]
normal = [1, 0]
[time]
end = 2e-2
max_steps = 40
[output]
frames = 300
fields = false
)toml";
INSTANTIATE_TEST_SUITE_P(OfScenes,
                         RanksOnRows,
                         testing::Values(Scene{"Disc", disc, ""},
                                         Scene{"DiscLeapfrogSingle", disc,
                                               "--set time.integrator=leapfrog --set "
                                               "scheme.precision=single"}),
                         [](const auto& tested) { return tested.param.name; });

TEST(RanksOfARun, GoOnFromACheckpointOfOtherRanks) {
  const Folder folder;
  folder.write("case.toml", cube + branches + held);
  const std::string run = "$diptych run case.toml --method fvm --quiet --threads 1 ";
  const std::string halves = "--set time.checkpoint_every=6 ";
  EXPECT_EQ(shell(folder, run + "--out whole").exit_code, 0);
  for (const auto& [first, second] : {std::pair{3, 2}, {2, 0}, {0, 5}}) {
    const auto on = [](int n) { return n == 0 ? "" : mpirun + "-n " + std::to_string(n) + " "; };
    const std::string out = " --out " + std::to_string(first) + "_" + std::to_string(second);
    Outcome outcome = shell(folder, on(first) + run + halves + "--set time.max_steps=6" + out);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    outcome = shell(folder, on(second) + run + halves + "--restart latest" + out);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_EQ(
        hash_in(folder.path() / (std::to_string(first) + "_" + std::to_string(second)) / "fvm"),
        hash_in(folder.path() / "whole/fvm"))
        << first << " to " << second << " ranks";
  }
}

TEST(RanksOfARun, BreakDownAsOneProcessDoes) {
  const Folder folder;
  folder.write("case.toml", cube);
  const std::string crushed = "'initial.velocity=[\"-2000*x\", 0, 0]'";
  const std::string turned =  // cells turn, and the step is taken back
      "'initial.velocity=[\"-300*(y-0.5)*sin(6*z)\", \"300*(x-0.5)*sin(6*z)\", 0]' --set "
      "time.end=0.05 --set output.frames=1 --set time.integrator=";
  for (const std::string& set : {crushed, turned + "leapfrog", turned + "ssp-rk3"}) {
    const std::string run =
        "$diptych run case.toml --method fvm --quiet --threads 1 --force --set time.max_steps=400 "
        "--set " +
        set;
    const Outcome alone = shell(folder, run + " --out 0");
    const Outcome three = shell(folder, mpirun + "-n 3 " + run + " --out 3");
    EXPECT_EQ(alone.exit_code, 3) << alone.text;
    EXPECT_EQ(three.exit_code, 3) << three.text;
    EXPECT_THAT(three.text, HasSubstr(alone.text.substr(0, alone.text.find('\n'))));
    if (set != crushed) {
      EXPECT_THAT(three.text, HasSubstr("left as it was before that step"));
    }
    EXPECT_EQ(hash_in(folder.path() / "3/fvm"), hash_in(folder.path() / "0/fvm")) << set;
  }
}

TEST(RanksOfARun, SayOnceWhatIsWrong) {
  const Folder folder;
  folder.write("case.toml", cube);
  const auto count = [](const std::string& text, const std::string& word) {
    size_t n = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
      ++n;
    return n;
  };
  for (const char* arguments : {"run case.toml --set material.modell=1", "run no-such-case",
                                "run case.toml --partition slap"}) {
    const Outcome outcome = shell(folder, mpirun + "-n 7 $diptych " + std::string(arguments));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_EQ(count(outcome.text, "diptych: "), 1U) << outcome.text;
  }
}

TEST(RanksOfARun, HavePatienceInSeconds) {
  const Folder folder;
  folder.write("case.toml", cube);
  const Outcome outcome =
      shell(folder, "export DIPTYCH_RANK_PATIENCE=long; " + mpirun + "-n 2 $diptych run case.toml");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("DIPTYCH_RANK_PATIENCE is no number of seconds"));
}

TEST(RanksOfARun, ArePartitionedWhereThereAreSome) {
  const Folder folder;
  folder.write("case.toml", cube);
  const Outcome outcome = shell(folder, "$diptych run case.toml --partition slab");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("--partition has no effect on one rank"));
}

TEST(RanksOfARun, AreToldInTheSummary) {
  const Folder folder;
  folder.write("case.toml", cube);
  const Outcome outcome =
      shell(folder, mpirun + "-n 2 $diptych run case.toml --method fvm --quiet --out two");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("2 ranks of "));
  const std::string summary = text_of(folder.path() / "two/fvm/summary.json");
  EXPECT_THAT(summary, HasSubstr("\"ranks\": 2"));
  EXPECT_THAT(summary, HasSubstr("\"exchanged_bytes\": "));
}

/// Every verb that runs cases takes ranks; what it writes is that of one process.
TEST(RanksOfARun, AreTakenByAllVerbs) {
  const Folder folder;
  std::string small = cube;
  small.replace(small.find("[10, 10, 10]"), 12, "[8, 4, 4]");
  small.replace(small.find("end = 5e-3\nmax_steps = 12"), 25, "end = 2e-3");
  std::filesystem::create_directories(folder.path() / "cases/beam");
  folder.write("cases/beam/case.toml", small);
  const std::string many = mpirun + "-n 3 $diptych ", one = "$diptych ";
  const std::string verbs[] = {"compare beam", "converge beam --levels 2",
                               "study beam --levels 2 --vary scheme.dissipation=0.5,1"};
  for (const std::string& verb : verbs) {
    for (const auto& [start, out] : {std::pair{one, "one"}, std::pair{many, "many"}}) {
      const Outcome outcome = shell(
          folder, start + verb + " --cases cases --threads 1 --quiet --out " + out + " --force");
      EXPECT_EQ(outcome.exit_code, 0) << verb << "\n" << outcome.text;
    }
    int n_runs = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() / "one")) {
      if (entry.path().filename() != "summary.json") continue;
      const auto run = entry.path().parent_path();
      const auto other = folder.path() / "many" / relative(run, folder.path() / "one");
      EXPECT_NE(hash_in(run), "none") << run;
      EXPECT_EQ(hash_in(run), hash_in(other)) << verb << " " << other;
      ++n_runs;
    }
    EXPECT_GE(n_runs, 2) << verb;
    std::filesystem::remove_all(folder.path() / "one");
    std::filesystem::remove_all(folder.path() / "many");
  }
  const std::string regress = "regress --cases cases --baselines baselines --quiet ";
  Outcome outcome = shell(folder, one + regress + "--bless beam --why 'the first'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  outcome = shell(folder, many + regress + "beam");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
}

/// A rank that is killed or stopped ends all of them within half a minute, is named, and the last
/// checkpoint goes on with fewer ranks to the bits of the run that was left alone.
TEST(RanksThatEnd, EndTheJobAndGoOnWithFewer) {
  const Folder folder;
  std::string text = cube + branches + held;
  text.replace(text.find("end = 5e-3\nmax_steps = 12"), 25,
               "end = 5e-2\nmax_steps = 150\ncheckpoint_every = 1");
  folder.write("case.toml", text);
  const std::string run = "$diptych run case.toml --method fvm --threads 1 --quiet --out ";
  ASSERT_EQ(shell(folder, run + "whole --set time.checkpoint_every=0").exit_code, 0);
  const std::string wanted = hash_in(folder.path() / "whole/fvm");
  std::mt19937 random(20);
  Trials trials("ranks killed or stopped");
  const int n_trials = Trials::n(2, 50);
  for (int k = 0; trials.n_made() < n_trials && k < 4 * n_trials; ++k) {
    const std::string signal = k % 2 == 0 ? "STOP" : "KILL";
    const auto victim = std::to_string(random() % 3);
    const std::string delay = "0." + std::to_string(10 + random() % 80);
    std::filesystem::remove_all(folder.path() / "out");
    const Outcome ended = shell(
        folder, "export DIPTYCH_RANK_PATIENCE=3; " + mpirun + "-n 3 " + run + "out &\n" +
                    "for i in $(seq 400); do ls out/fvm/checkpoint_* >/dev/null 2>&1 && break; "
                    "sleep 0.05; done; sleep " +
                    delay +
                    "\nfor p in $(pgrep -P $!); do tr '\\0' '\\n' </proc/$p/environ | grep -qx "
                    "OMPI_COMM_WORLD_RANK=" +
                    victim + " && kill -" + signal +
                    " $p && hit=yes; done\nstart=$(date +%s)\njob=$!\n"
                    "for i in $(seq 600); do kill -0 $job 2>/dev/null || break; sleep 0.1; done\n"
                    "for p in $(pgrep -P $job); do case $(ps -o stat= -p $p) in [TZ]*) ;; ?*) echo "
                    "waits=$p ;; esac; done\n"
                    "kill -0 $job 2>/dev/null && { ps -e -o pid,ppid,stat,etime,args | tail -20; "
                    "pkill -KILL -P $job; kill -KILL $job; }\nwait $job\ncode=$?\n"
                    "echo \"hit=$hit code=$code after $(($(date +%s) - start)) s\"");
    const auto says = [&](const char* what) { return ended.text.find(what) != std::string::npos; };
    // one that is stopped after its last word holds mpirun: all that there was to do is done, and
    // no other rank waits for it
    const bool was_over = !says("hit=yes") || says("status done");
    if (says("waits=")) ADD_FAILURE() << "rank " << victim << " " << signal << "\n" << ended.text;
    if (was_over) continue;
    std::smatch after;
    const bool is_told = std::regex_search(ended.text, after, std::regex(R"(after (\d+) s)")) &&
                         std::stoi(after[1].str()) < 30;
    EXPECT_TRUE(is_told) << ended.text;
    const bool is_named = std::regex_search(ended.text, std::regex("rank " + victim));
    EXPECT_TRUE(is_named) << "rank " << victim << " " << signal << "\n" << ended.text;
    const int fewer = static_cast<int>(random() % 2) + 1;
    const Outcome again =
        shell(folder, mpirun + "-n " + std::to_string(fewer) + " " + run + "out --restart latest");
    const bool goes_on = again.exit_code == 0 && hash_in(folder.path() / "out/fvm") == wanted;
    EXPECT_TRUE(goes_on) << ended.text << again.text;
    trials.add(is_told && is_named && goes_on);
  }
  EXPECT_EQ(trials.n_made(), n_trials) << "too many runs were over before";
}

}  // namespace
}  // namespace diptych::tests
