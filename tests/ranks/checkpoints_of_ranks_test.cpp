/// What ranks keep goes on, with the bits of a run that was left alone, on as many ranks as there
/// are then.

#include "tests/ranks/ranks.hpp"
#include "tests/trials.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <random>
#include <regex>

namespace diptych::tests {
namespace {

using testing::HasSubstr;

/// By the stages of a step; and by leapfrog, where volumes of cells and what holds unseen motions
/// remember forces of the step before.
class RanksThatGoOn : public testing::TestWithParam<Scene> {};
TEST_P(RanksThatGoOn, FromACheckpointOfOtherRanks) {
  const Folder folder;
  folder.write("case.toml", GetParam().text);
  const std::string run = "$diptych run case.toml --quiet --threads 1 " + GetParam().options;
  const std::string halves = " --set time.checkpoint_every=6 ";
  EXPECT_EQ(shell(folder, run + " --out whole").exit_code, 0);
  for (const auto& [first, second] : {std::pair{3, 2}, {2, 0}, {0, 5}}) {
    const auto on = [](int n) {
      return n == 0 ? ""
                    : "export DIPTYCH_RANK_MEMORY=poisoned; " + mpirun + "-n " + std::to_string(n) +
                          " ";
    };
    const std::string out = std::to_string(first) + "_" + std::to_string(second);
    Outcome outcome =
        shell(folder, on(first) + run + halves + "--set time.max_steps=6 --out " + out);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    outcome = shell(folder, on(second) + run + halves + "--restart latest --out " + out);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    for (const char* method : {"sph", "fvm"}) {
      if (!std::filesystem::exists(folder.path() / "whole" / method)) continue;
      EXPECT_EQ(hash_in(folder.path() / out / method), hash_in(folder.path() / "whole" / method))
          << first << " to " << second << " ranks, " << method;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(
    OfScenes,
    RanksThatGoOn,
    testing::Values(Scene{"Branches", cube + branches + held, "--method fvm"},
                    Scene{"CellsAndEdges", cube + held,
                          "--method sph --set mesh.perturbation=0.2 --set scheme.volumes=cells "
                          "--set time.integrator=leapfrog"}),
    [](const auto& tested) { return tested.param.name; });

TEST(RanksOfARun, SayWhichCheckpointIsOfAnotherRun) {
  const Folder folder;
  folder.write("case.toml", cube);
  const std::string run = "$diptych run case.toml --method fvm --quiet --threads 1 --out out ";
  ASSERT_EQ(shell(folder, run + "--set time.checkpoint_every=6").exit_code, 0);
  folder.write("case.toml", cube + branches);
  const Outcome other = shell(folder, mpirun + "-n 3 " + run + "--restart latest");
  EXPECT_EQ(other.exit_code, 2) << other.text;
  EXPECT_THAT(other.text, HasSubstr("checkpoint_00000012.hdf"));
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
