/// Runs among ranks have the bits of a run of one process: state and histories, for both methods,
/// rows and runs of pairs, both precisions, and all that ranks tell each other of.

#include "tests/ranks/ranks.hpp"

#include "tests/command_line/frames.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych::tests {
namespace {

using testing::HasSubstr;

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
  const std::string known = R"toml([exact]
displacement = ["20*t*y*z", "-30*t*x", "10*t*sin(3*x)"]
velocity = ["20*y*z", "-30*x", "10*sin(3*x)"]
)toml";
  const std::string stopped = R"toml([[boundary]]
group = "x_max"
type = "traction"
value = ["t < 4.321e-4 ? 1e5 : 0", 0, "(t > 1e-4 && t < 1.01e-4) ? 1e6 : 0"]
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
      {"ExactSolution", cube + probes + known, ""},
      {"LoadsThatJump", cube + stopped, "--set time.integrator=leapfrog"},
      {"LoadsThatJumpInStages", cube + stopped, "--set time.integrator=ssp-rk3"},
      {"RigidWall", plane + wall, "--set time.integrator=leapfrog"},
      {"RigidWallInStages", plane + wall, ""},
      {"PressureAndVelocity", plane + blown, "--set scheme.volumes=cells"},
  };
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
      EXPECT_THAT(errors_in(a), HasSubstr("least_J"));
      EXPECT_EQ(errors_in(a), errors_in(b)) << method;
      if (std::filesystem::exists(a / "exact.csv")) {
        EXPECT_EQ(text_of(a / "exact.csv"), text_of(b / "exact.csv")) << method;
      }
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

/// The program with another build id: as good as another build.
void copy_as_another_build(const std::filesystem::path& to) {
  const std::filesystem::path from = build_folder();
  std::filesystem::copy_file(from / "diptych", to / "other");
  std::filesystem::create_symlink(from / "libdiptych_mpi.so", to / "libdiptych_mpi.so");
  std::string bytes = text_of(to / "other");
  const size_t note = bytes.find(std::string("\3\0\0\0GNU\0", 8));  // its type, its owner
  ASSERT_NE(note, std::string::npos);
  bytes[note + 8] ^= 1;
  std::ofstream(to / "other", std::ios::binary) << bytes;
}

/// Environments of machines differ: what only one rank has ends all with a message, or nothing.
TEST(RanksOfARun, EndTogetherWhereOneAloneHasAFault) {
  const Folder folder;
  folder.write("case.toml", cube);
  copy_as_another_build(folder.path());
  struct Start {
    const char *what, *of_rank_1;  ///< $run: the arguments
    int code;
    const char* message;
  };
  const Start starts[] = {
      {"threads", "env OMP_THREAD_LIMIT=1 $diptych $run", 2, "rank 1 of 2: 3 threads are more"},
      {"patience", "env DIPTYCH_RANK_PATIENCE=long $diptych $run", 4,
       "seconds from 0 to 1000000 (rank 1 of 2)"},
      {"no patience", "env DIPTYCH_RANK_PATIENCE=0 $diptych $run", 0, "2 ranks of"},
      {"stack", "sh -c \"ulimit -s 128; exec $diptych $run\"", 4,
       "rank 1 of 2: the stack of a process"},
      {"build", "./other $run", 4, "rank 1 of 2 is another program"},
  };
  for (const Start& one : starts) {
    const Outcome outcome = shell(
        folder,
        std::string("run='run case.toml --method fvm --threads 3 --quiet --out out --force'\n") +
            mpirun + "--timeout 60 -n 1 $diptych $run : -n 1 " + one.of_rank_1);
    EXPECT_EQ(outcome.exit_code, one.code) << one.what << "\n" << outcome.text;
    const size_t first = outcome.text.find(one.message);
    EXPECT_NE(first, std::string::npos) << one.what << "\n" << outcome.text;
    EXPECT_EQ(outcome.text.find(one.message, first + 1), std::string::npos) << outcome.text;
  }
}

/// Who drains a machine signals its ranks alone: rank 0 is told, and does what is asked for.
TEST(RanksOfARun, PassSignalsToRankZero) {
  const Folder folder;
  folder.write("case.toml", cube);
  const Outcome outcome = shell(
      folder,
      "run='run case.toml --method fvm --threads 1 --quiet --out out --set time.end=5 --set "
      "time.max_steps=1000000 --set output.frames=100000'\n" +
          mpirun +
          "--timeout 100 -n 2 $diptych $run : -n 1 sh -c \"echo \\$\\$ >pid; exec $diptych $run\" "
          "&\n"
          "for i in $(seq 400); do [ -s out/fvm/history.csv ] && break; sleep 0.05; done\n"
          "kill -USR1 $(cat pid)\n"
          "for i in $(seq 200); do ls out/fvm/checkpoint_* 2>/dev/null && break; sleep 0.05; done\n"
          "kill -TERM $(cat pid); wait $!");
  EXPECT_EQ(outcome.exit_code, 130) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("out/fvm/checkpoint_")) << "of SIGUSR1";
  EXPECT_THAT(outcome.text, HasSubstr("ending after this step, since rank 2 was sent SIGTERM"));
  EXPECT_THAT(text_of(folder.path() / "out/fvm/summary.json"), HasSubstr("\"interrupted\""));
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

}  // namespace
}  // namespace diptych::tests
