/// A run that goes on from a checkpoint leaves what the run that never ended leaves; a damaged
/// checkpoint, one of another run and none at all are told apart, with code 2.

#include "tests/command_line/frames.hpp"
#include "tests/command_line/small_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <random>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::expect_same_frames;
using tests::Folder;
using tests::Outcome;
using tests::shell;
using tests::summary_in;
using tests::text_of;

/// Some dozens of steps.
const std::string scene =
    tests::cube + "[time]\nend = 0.05\n[output]\nframes = 5\n" + tests::probes;
const std::string run = "run case.toml --threads 1 --quiet --out ";

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Checkpoints in the folder of a run, the latest first.
std::vector<fs::path> checkpoints_in(const fs::path& directory) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();  // unfinished ones end with .tmp
    if (name.starts_with("checkpoint_") && name.ends_with(".hdf")) found.push_back(entry.path());
  }
  std::sort(found.rbegin(), found.rend());
  return found;
}

/// All that the runs have left, but for dates and what it took.
void expect_same_results(const fs::path& a, const fs::path& b) {
  for (const char* name : {"history.csv", "steps.csv"})
    EXPECT_EQ(text_of(b / name), text_of(a / name)) << name;
  expect_same_frames(a, b);
  const auto wanted = summary_in(a), found = summary_in(b);
  EXPECT_EQ(found.status, wanted.status);
  EXPECT_EQ(found.state_hash, wanted.state_hash);
  EXPECT_EQ(found.steps, wanted.steps);
  EXPECT_EQ(found.rejected_steps, wanted.rejected_steps);
  EXPECT_EQ(found.projections, wanted.projections);
  EXPECT_EQ(found.resynchronisations, wanted.resynchronisations);
  EXPECT_EQ(found.limited_pairs, wanted.limited_pairs);
  EXPECT_EQ(found.dt_min, wanted.dt_min);
  EXPECT_EQ(found.dt_max, wanted.dt_max);
  EXPECT_EQ(found.min_jacobian, wanted.min_jacobian);
  EXPECT_EQ(found.least_cell_J, wanted.least_cell_J);
  EXPECT_EQ(found.linear_momentum_drift, wanted.linear_momentum_drift);
  EXPECT_EQ(found.angular_momentum_drift, wanted.angular_momentum_drift);
  EXPECT_EQ(found.energy.relative_residual, wanted.energy.relative_residual);
  EXPECT_EQ(found.energy.numerical_dissipation, wanted.energy.numerical_dissipation);
}

class Restarted : public testing::Test {
 protected:
  Restarted() {
    folder.write("case.toml", scene);
    const auto whole = command(run + "whole");
    EXPECT_EQ(whole.exit_code, 0) << whole.text;
  }
  Outcome command(const std::string& arguments) const { return diptych(folder, arguments); }
  /// Ended after this step, with a checkpoint after every `every` steps until then.
  void end_after(int step, int every, const std::string& more = "") const {
    const auto outcome = command(fmt::format(
        "{}out --set time.max_steps={} --set time.checkpoint_every={} {}", run, step, every, more));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  }
  fs::path out(const std::string& method) const { return folder.path() / "out" / method; }
  void expect_same(const std::string& method) const {
    expect_same_results(folder.path() / "whole" / method, out(method));
  }
  Folder folder;
};

TEST_F(Restarted, LeavesWhatTheRunThatNeverEndedLeaves) {
  end_after(17, 5);
  EXPECT_EQ(summary_in(out("sph")).status, "step limit");
  const auto again = command(
      "run case.toml --quiet --out out --restart latest --threads 2 "
      "--set time.max_steps=31 --set time.checkpoint_every=5");
  EXPECT_EQ(again.exit_code, 0) << again.text;
  EXPECT_EQ(summary_in(out("fvm")).steps, 31);
  const auto last = command("run case.toml --out out --threads 2 --restart latest");
  EXPECT_EQ(last.exit_code, 0) << last.text;
  EXPECT_THAT(last.text,
              AllOf(HasSubstr("sph level 0: goes on from out/sph/checkpoint_00000031.hdf, step 31"),
                    HasSubstr("went on from a checkpoint 2 times")));
  for (const char* method : {"sph", "fvm"}) {
    EXPECT_EQ(summary_in(out(method)).restarts, 2);
    expect_same(method);
  }
}

TEST_F(Restarted, KeepsTheTwoLatest) {
  end_after(17, 5);
  const auto found = checkpoints_in(out("fvm"));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].filename(), "checkpoint_00000017.hdf");
  EXPECT_EQ(found[1].filename(), "checkpoint_00000015.hdf");
}

TEST_F(Restarted, GoesOnFromTheFileThatIsNamed) {
  end_after(17, 5);
  const auto again = command("run case.toml --restart out/fvm/checkpoint_00000015.hdf");
  EXPECT_EQ(again.exit_code, 0) << again.text;
  EXPECT_THAT(again.text, AllOf(HasSubstr("step 15"), Not(HasSubstr("sph level 0"))));
  expect_same("fvm");
  EXPECT_TRUE(checkpoints_in(out("fvm")).size() == 1) << "those of later steps are another run's";
  EXPECT_EQ(summary_in(out("sph")).status, "step limit") << "is not touched";
}

TEST_F(Restarted, AfterASignalThatEndedIt) {
  for (const char* signal : {"INT", "TERM"}) {
    fs::remove_all(folder.path() / "out");
    // the same scene, with hours of steps between the same instants
    const std::string slow = " --method fvm --level 2 --set time.end=50 --set output.frames=5000";
    const auto ended =
        shell(folder,
              fmt::format("timeout --preserve-status -s {} 3 $diptych {}out{}", signal, run, slow));
    EXPECT_EQ(ended.exit_code, 130) << ended.text;
    EXPECT_THAT(ended.text, HasSubstr("with --restart latest the same command goes on"));
    const auto summary = summary_in(out("fvm"));
    EXPECT_EQ(summary.status, "interrupted");
    const auto found = checkpoints_in(out("fvm"));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_THAT(found[0].string(), HasSubstr(fmt::format("{:08}", summary.steps)));
    const std::string end = fmt::format(" --set time.max_steps={}", summary.steps + 20);
    EXPECT_EQ(command(run + "out --restart latest" + slow + end).exit_code, 0);
    EXPECT_EQ(command(run + "other" + slow + end).exit_code, 0);
    expect_same_results(folder.path() / "other" / "fvm", out("fvm"));
  }
}

TEST_F(Restarted, AfterAKillAtAnyInstant) {
  std::mt19937 random(5);
  int n_restarts = 0;
  for (int trial = 0; trial < 6; ++trial) {
    fs::remove_all(folder.path() / "out");
    const double instant = 0.05 + 1e-3 * static_cast<double>(random() % 500);
    shell(folder, fmt::format("timeout -s KILL {} $diptych {}out --method fvm "
                              "--set time.checkpoint_every=1",
                              instant, run));
    const bool has_any = fs::exists(out("fvm")) && !checkpoints_in(out("fvm")).empty();
    if (!has_any) continue;
    const auto again = command(run + "out --method fvm --restart latest");
    EXPECT_EQ(again.exit_code, 0) << again.text;
    EXPECT_THAT(again.text, Not(HasSubstr("damaged")));
    expect_same("fvm");
    ++n_restarts;
  }
  EXPECT_GT(n_restarts, 0) << "every run was killed before its first checkpoint";
}

TEST_F(Restarted, FallsBackWhereTheLatestIsDamaged) {
  end_after(17, 5, "--method fvm");
  const fs::path latest = checkpoints_in(out("fvm"))[0];
  const std::string whole = text_of(latest);
  std::mt19937 random(3);
  for (int trial = 0; trial < 8; ++trial) {
    std::string damaged = whole;
    if (trial % 2 == 0) {
      damaged[random() % whole.size()] ^= static_cast<char>(1 << random() % 8);
    } else {
      damaged.resize(random() % whole.size());
    }
    write_bytes(latest, damaged);
    const auto named = command(run + "out --restart " + latest.string());
    EXPECT_EQ(named.exit_code, 2) << named.text;
    EXPECT_THAT(named.text,
                AllOf(HasSubstr(latest.string()), testing::ContainsRegex("damaged|cut off")));
  }
  const auto again = command(run + "out --method fvm --restart latest");
  EXPECT_EQ(again.exit_code, 0) << again.text;
  EXPECT_THAT(again.text, AllOf(HasSubstr("checkpoint_00000017.hdf"),
                                HasSubstr("an earlier checkpoint is taken")));
  expect_same("fvm");
}

TEST_F(Restarted, IsRefusedWhereNoneIsWhole) {
  end_after(17, 5, "--method fvm");
  for (const fs::path& path : checkpoints_in(out("fvm")))
    write_bytes(path, text_of(path).substr(0, 5000));
  const std::string history = text_of(out("fvm") / "history.csv");
  const auto again = command(run + "out --method fvm --restart latest");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.text, AllOf(HasSubstr("none of the checkpoints can be used"),
                                HasSubstr("checkpoint_00000015.hdf"),
                                HasSubstr("checkpoint_00000017.hdf"), HasSubstr("5000 bytes")));
  EXPECT_EQ(text_of(out("fvm") / "history.csv"), history) << "what lies there stays";
}

/// Moved, copied, behind a link: a case with the same text goes on, another one changes no file.
TEST_F(Restarted, GoesOnFromAnotherPathOfItsCase) {
  end_after(17, 5, "--method fvm");
  for (const char* name : {"moved", "other"})
    fs::create_directories(folder.path() / name);
  folder.write("other/case.toml", scene + "# of another text\n");
  fs::rename(folder.path() / "case.toml", folder.path() / "moved/case.toml");
  fs::create_directory_symlink("moved", folder.path() / "link");
  const std::string restart = " --method fvm --threads 1 --quiet --out out --restart ";
  const std::string named = checkpoints_in(out("fvm"))[0].string();
  for (const std::string& from : {std::string("latest"), named}) {
    const auto other = command("run other --force" + restart + from);
    EXPECT_EQ(other.exit_code, 2) << other.text;
    EXPECT_THAT(other.text, AllOf(HasSubstr("results of another case"),
                                  HasSubstr("whose text is not that of"), HasSubstr("--out")));
    EXPECT_EQ(checkpoints_in(out("fvm")).size(), 2u);
  }
  const auto again = command("run link --force" + restart + "latest");
  EXPECT_EQ(again.exit_code, 0) << again.text;
  expect_same("fvm");
}

/// Bits are those of the run that never ended, or the run says that they are not.
TEST_F(Restarted, TellsOfOtherInstantsOfOutput) {
  for (const auto& [first, is_told] : std::vector<std::pair<std::string, bool>>{
           {"--set time.end=0.02 --set output.frames=2", false},
           {"--set time.end=0.025 --set output.frames=3", true},
           {"--set output.frames=7 --set time.max_steps=17", true},
           {"--set output.frames=7 --set time.max_steps=3", true},
           {"--set output.frames=1 --set time.max_steps=30", true}}) {
    fs::remove_all(folder.path() / "out");
    const std::string fvm = "--method fvm --set time.checkpoint_every=100 ";
    ASSERT_EQ(command(run + "out " + fvm + first).exit_code, 0);
    const auto again = command("run case.toml --threads 1 --out out --restart latest " + fvm);
    EXPECT_EQ(again.exit_code, 0) << again.text;
    for (const std::string& text : {again.text, text_of(out("fvm") / "summary.json")})
      EXPECT_EQ(text.find("other instants of output") != std::string::npos, is_told) << first;
    EXPECT_EQ(
        summary_in(out("fvm")).state_hash == summary_in(folder.path() / "whole" / "fvm").state_hash,
        !is_told)
        << first;
  }
}

TEST_F(Restarted, IsRefusedForAnotherRun) {
  end_after(17, 5, "--method fvm");
  const std::string file = " --restart " + checkpoints_in(out("fvm"))[0].string();
  const std::string summary = text_of(out("fvm") / "summary.json");
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {" --method fvm --set material.density=1000" + file,
            "another case: material.density was 1100, is 1000"},
           {" --method fvm --set material.density=1000 --restart latest", "material.density"},
           {" --method fvm --set time.cfl=0.5" + file, "time.cfl was not given, is 0.5"},
           {" --method fvm --level 1" + file, "is of level 0, the run is of level 1"},
           {" --method sph" + file, "is of method fvm, --method asks for sph"},
           {" --method fvm --set time.end=1e-3" + file, "is before the state to go on from"},
           {" --method sph --restart latest", "there is no checkpoint in out/sph"},
           {" --method fvm --restart nowhere.hdf", "nowhere.hdf: there is no such file"}}) {
    const auto again = command(run + "out" + arguments);
    EXPECT_EQ(again.exit_code, 2) << again.text;
    EXPECT_THAT(again.text, HasSubstr(message));
  }
  const auto elsewhere = command(run + "other" + file);
  EXPECT_EQ(elsewhere.exit_code, 2);
  EXPECT_THAT(elsewhere.text, HasSubstr("a run goes on in its own folder"));
  EXPECT_FALSE(fs::exists(folder.path() / "other"));
  fs::remove(out("fvm") / "frame_0000.hdf");
  const auto missing = command(run + "out --method fvm --restart latest");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.text, HasSubstr("frame_0000.hdf: is missing"));
  EXPECT_EQ(text_of(out("fvm") / "summary.json"), summary) << "a refusal changes nothing";
}

/// Two squares, held at one end and pulled at the other.
TEST_F(Restarted, IsRefusedWhereGroupsOfTheMeshHaveChanged) {
  const auto mesh = [](const char* first, const char* second) {
    return fmt::format(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"{}\"\n1 2 \"{}\"\n"
        "$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n"
        "$EndNodes\n$Elements\n4\n1 1 2 1 1 1 4\n2 1 2 2 2 3 6\n3 3 2 3 3 1 2 5 4\n"
        "4 3 2 3 3 2 3 6 5\n$EndElements\n",
        first, second);
  };
  folder.write("body.msh", mesh("held", "pulled"));
  folder.write("case.toml",
               "[mesh]\nfile = \"body.msh\"\nelement = \"quadrilateral\"\n[material]\n"
               "model = \"neo-hookean\"\ndensity = 1\nyoungs_modulus = 1\npoissons_ratio = 0.3\n"
               "[[boundary]]\ngroup = \"held\"\ntype = \"fixed\"\n[[boundary]]\n"
               "group = \"pulled\"\ntype = \"traction\"\nvalue = [1e-3, 0]\n[time]\nend = 10\n");
  fs::remove_all(folder.path() / "out");
  end_after(7, 5, "--method fvm");
  folder.write("body.msh", mesh("pulled", "held"));
  const auto again = command(run + "out --method fvm --restart latest");
  EXPECT_EQ(again.exit_code, 2) << again.text;
  EXPECT_THAT(again.text, HasSubstr("is of other boundary groups"));
}

TEST_F(Restarted, OfBothMethodsTakesOverWhatIsFinished) {
  const auto first = command(run + "out --method sph");
  ASSERT_EQ(first.exit_code, 0) << first.text;
  const auto second = command(run + "out --restart latest");
  EXPECT_EQ(second.exit_code, 0) << second.text;
  EXPECT_THAT(second.text, AllOf(HasSubstr("taken over, not run again: out/sph"),
                                 HasSubstr("no checkpoint in out/fvm: this run begins at t = 0")));
  expect_same("sph");
  expect_same("fvm");
}

TEST_F(Restarted, GoesOnToALaterEnd) {
  const auto first = command(run + "out --method fvm --set time.checkpoint_every=1000");
  ASSERT_EQ(first.exit_code, 0) << first.text;
  ASSERT_EQ(checkpoints_in(out("fvm")).size(), 1u) << "one at the end";
  const auto second = command(run +
                              "out --method fvm --restart latest --set time.end=0.06 "
                              "--set output.frames=6");
  EXPECT_EQ(second.exit_code, 0) << second.text;
  const auto rows = io::history_from_csv(text_of(out("fvm") / "history.csv"), "history.csv");
  EXPECT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows.back().time, 0.06);
  EXPECT_EQ(io::read_series((out("fvm") / "run.hdf.series").string()).size(), 7u);
}

// The shear modulus is 6.5e6 Pa: the ramp passes 1.5 of it before the later end.
TEST_F(Restarted, IsRefusedWhereALaterEndMakesTheDefaultsCarryAStrongPressure) {
  folder.write("case.toml", scene + R"([[boundary]]
group = "x_max"
type = "pressure"
value = "1e8*t"
)");
  const auto first = command(run + "out --method sph --set time.checkpoint_every=1000");
  ASSERT_EQ(first.exit_code, 0) << first.text;
  EXPECT_EQ(summary_in(out("sph")).volumes, "nodes");
  const auto later = command(run + "out --method sph --restart latest --set time.end=0.15");
  EXPECT_EQ(later.exit_code, 2) << later.text;
  EXPECT_THAT(later.text,
              AllOf(HasSubstr("a run whose pressure nodes carry"), HasSubstr("comes to lines now"),
                    HasSubstr("before one time.end and not before the other")));
}

TEST_F(Restarted, WritesACheckpointWhenASignalAsksForIt) {
  const auto outcome = shell(
      folder,
      "$diptych " + run +
          "out --method fvm --level 2 --set time.end=50 & pid=$!\n"
          "for i in $(seq 100); do test -s out/fvm/history.csv && break; sleep 0.1; done; sleep 1\n"
          "kill -USR1 $pid; for i in $(seq 100); do ls out/fvm/checkpoint_*.hdf 2>/dev/null && "
          "break; sleep 0.1; done; kill -0 $pid && echo goes on; kill -KILL $pid");
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("out/fvm/checkpoint_"), HasSubstr("goes on")));
}

TEST_F(Restarted, EndsWithCode4WhereACheckpointCannotBeWritten) {
  const auto outcome =
      shell(folder, "bash -c 'ulimit -f 40; exec '$diptych' " + run +
                        "out --method fvm --no-fields --set time.checkpoint_every=5'");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.text;
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("checkpoint_00000005.hdf"), HasSubstr("File too large")));
  EXPECT_EQ(summary_in(out("fvm")).status, "failed");
  EXPECT_TRUE(checkpoints_in(out("fvm")).empty());
}

}  // namespace
}  // namespace diptych
