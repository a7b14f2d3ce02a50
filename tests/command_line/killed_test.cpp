/// Whatever ends a run, its folder tells the truth: rows until then are readable, and no summary
/// says "running" of a run that the program itself has given up.

#include "common/io/run_record.hpp"
#include "tests/command_line/small_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::cube;
using tests::Folder;
using tests::probes;
using tests::shell;
using tests::summary_in;
using tests::text_of;

/// Hours of steps, with an output time every few of them.
const std::string endless =
    cube + "[time]\nend = 500\n[output]\nframes = 1000000\nfields = false\n";

TEST(Killed, LeavesAllRowsUntilThen) {
  const Folder folder;
  folder.write("case.toml", endless + probes);
  shell(folder,
        "timeout -s KILL 4 $diptych run case.toml --method fvm --threads 1 --quiet --out out");
  const fs::path directory = folder.path() / "out" / "fvm";
  EXPECT_EQ(summary_in(directory).status, "running") << "it could not say more";
  const auto history = io::history_from_csv(text_of(directory / "history.csv"), "history.csv");
  ASSERT_GT(history.size(), 100u);
  EXPECT_EQ(history.front().time, 0);
  EXPECT_EQ(history.back().probes.size(), 2u);
  EXPECT_GT(history.back().time, history[history.size() - 2].time);
  const auto steps = io::columns_from_csv(text_of(directory / "steps.csv"), "steps.csv");
  EXPECT_GE(steps.front().values.back(), history[history.size() - 2].time);
}

TEST(Killed, RowsAreThoseThatAFinishedRunHas) {
  const Folder folder;
  folder.write("case.toml", cube + "[time]\nend = 1e-2\n[output]\nframes = 7\n" + probes);
  const auto outcome = tests::diptych(folder, "run case.toml --threads 1 --quiet --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  for (const char* method : {"sph", "fvm"}) {
    const fs::path directory = folder.path() / "out" / method;
    const std::string text = text_of(directory / "history.csv");
    const auto rows = io::history_from_csv(text, "history.csv");
    EXPECT_EQ(rows.size(), 8u);
    EXPECT_EQ(text, io::history_csv(rows, {"speed [m/s]", "at a corner [m]"}));
    const auto steps = io::columns_from_csv(text_of(directory / "steps.csv"), "steps.csv");
    ASSERT_EQ(steps.size(), 3u);
    EXPECT_EQ(steps[0].values.size(), static_cast<size_t>(summary_in(directory).steps) + 1);
    EXPECT_EQ(steps[2].values.back(), rows.back().probes[0]);
  }
}

TEST(Hangup, IsAnInterruptUnlessItIsIgnored) {
  const Folder folder;
  folder.write("case.toml", endless);
  const std::string run = " $diptych run case.toml --method fvm --threads 1 --quiet --out ";
  const auto hung_up =
      shell(folder, "timeout --preserve-status -s HUP 2" + run + "out; echo code $?");
  EXPECT_THAT(hung_up.text, HasSubstr("code 130"));
  EXPECT_EQ(summary_in(folder.path() / "out" / "fvm").status, "interrupted");
  // the signal of a terminal that closes leaves a run under nohup alone; what ends it comes later
  const auto kept = shell(folder, "nohup" + run +
                                      "kept > /dev/null 2>&1 & pid=$!; sleep 1.5; "
                                      "kill -HUP $pid; sleep 1; kill -0 $pid && echo alive; "
                                      "kill -TERM $pid; wait $pid; echo code $?");
  EXPECT_THAT(kept.text, AllOf(HasSubstr("alive"), HasSubstr("code 130")));
}

TEST(FullDisk, LeavesTheStatusFailedWithItsMessage) {
  const Folder folder;
  folder.write("case.toml", endless + probes);
  const auto outcome =
      shell(folder,
            "bash -c 'ulimit -f 16; exec '$diptych' run case.toml --method sph --threads 1 "
            "--quiet --out out'");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr(".csv"), HasSubstr("free space")));
  const auto summary = summary_in(folder.path() / "out" / "sph");
  EXPECT_EQ(summary.status, "failed");
  ASSERT_TRUE(summary.failure.has_value());
  EXPECT_THAT(summary.failure->message, HasSubstr("File too large"));
  EXPECT_GT(summary.failure->time, 0);
}

TEST(FullDisk, LeavesTheStatusFailedWhereNoFrameFits) {
  const Folder folder;
  folder.write("case.toml", cube + "[time]\nend = 1e-2\n");
  const auto outcome =
      shell(folder,
            "bash -c 'ulimit -f 16; exec '$diptych' run case.toml --method sph --threads 1 "
            "--level 2 --quiet --out out'");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.text;
  const auto summary = summary_in(folder.path() / "out" / "sph");
  EXPECT_EQ(summary.status, "failed");
  EXPECT_FALSE(summary.failure.value_or(io::RunFailure{}).message.empty());
}

/// A case whose expression has no value from t = 5.5 ms on.
TEST(Expression, WithoutAValueLeavesTheStatusFailedWithItsPlace) {
  for (const char* section : {"[[probe]]\nname = \"root\"\nunit = \"-\"\nkind = \"mean\"\nquantity "
                              "= \"sqrt(55e-4 - t)\"\n",
                              "[exact]\nvelocity = [\"sqrt(55e-4 - t)\", 0, 0]\n",
                              "[[boundary]]\ngroup = \"x_min\"\ntype = \"velocity\"\n"
                              "value = [\"sqrt(55e-4 - t)\", 0, 0]\n"}) {
    const Folder folder;
    folder.write("case.toml", cube + "[time]\nend = 1e-2\n[output]\nfields = false\n" + section);
    const auto outcome =
        tests::diptych(folder, "run case.toml --method fvm --threads 1 --quiet --out out");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    const fs::path directory = folder.path() / "out" / "fvm";
    const auto summary = summary_in(directory);
    EXPECT_EQ(summary.status, "failed") << section;
    ASSERT_TRUE(summary.failure.has_value()) << section;
    EXPECT_THAT(summary.failure->message,
                AllOf(HasSubstr("case.toml:"), HasSubstr("sqrt(55e-4 - t)"), HasSubstr("nan")));
    EXPECT_GT(summary.failure->time, 4e-3);
    const auto history = io::history_from_csv(text_of(directory / "history.csv"), "history.csv");
    EXPECT_GE(history.back().time, 5e-3) << "rows until then";
  }
}

#if DIPTYCH_GMSH_FOUND
/// A case whose mesh takes gmsh minutes; temporary files go to tmp.
void write_slow_mesh(const Folder& folder) {
  fs::create_directories(folder.path() / "tmp");
  folder.write("case.geo",
               "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"
               "Mesh.MeshSizeMax = 0.008;\nMesh.MeshSizeMin = 0.008;\n"
               "Physical Volume(\"body\") = {1};\n");
  std::string text = cube + "[time]\nend = 1e-3\n";
  const std::string box = "lower = [0, 0, 0]\nupper = [1, 1, 1]\ncells = [4, 4, 4]";
  text.replace(text.find(box), box.size(), "file = \"case.geo\"\nsize = 0.008");
  text.replace(text.find("hexahedron"), 10, "tetrahedron");
  folder.write("case.toml", text);
}

/// Starts the program, waits until gmsh runs, and sends a signal; $child is gmsh.
std::string signal_while_meshing(const std::string& signal) {
  return "export TMPDIR=$PWD/tmp; $diptych run case.toml --quiet --out out & pid=$!; "
         "for i in $(seq 100); do child=$(cat /proc/$pid/task/$pid/children); "
         "test -n \"$child\" && break; sleep 0.1; done; sleep 0.5; "
         "test -n \"$child\" && echo was meshing; ls tmp; kill -" +
         signal + " $pid; ";
}

TEST(Meshing, EndsWithTheProgramAndLeavesNoFolder) {
  for (const char* signal : {"TERM", "INT", "HUP"}) {
    const Folder folder;
    write_slow_mesh(folder);
    const auto outcome =
        shell(folder, signal_while_meshing(signal) +
                          "wait $pid; echo code $?; "
                          "for c in $child; do kill -0 $c 2>/dev/null && echo gmsh lives; done");
    EXPECT_THAT(outcome.text,
                AllOf(HasSubstr("was meshing"), HasSubstr("diptych-mesh"), HasSubstr("code 130"),
                      HasSubstr("nothing had been computed"), Not(HasSubstr("gmsh lives"))))
        << signal;
    EXPECT_TRUE(fs::is_empty(folder.path() / "tmp")) << signal;
    EXPECT_FALSE(fs::exists(folder.path() / "out")) << signal;
  }
}

TEST(Meshing, EndsWithAProgramThatIsKilled) {
  const Folder folder;
  write_slow_mesh(folder);
  const auto outcome =
      shell(folder, signal_while_meshing("KILL") +
                        "sleep 0.5; for c in $child; do "
                        "grep -q '^State:.[^Z]' /proc/$c/status 2>/dev/null && echo gmsh lives; "
                        "done; echo looked");
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("was meshing"), HasSubstr("looked"), Not(HasSubstr("gmsh lives"))));
}
#endif

}  // namespace
}  // namespace diptych
