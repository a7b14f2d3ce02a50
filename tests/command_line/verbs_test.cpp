/// The verbs, through the program: what they print and what they leave.

#include "common/io/field_writer.hpp"
#include "common/io/hdf5_file.hpp"
#include "common/io/run_record.hpp"
#include "tests/command_line/program.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using tests::diptych;
using tests::Folder;
using tests::text_of;

TEST(Verbs, RunLeavesSummaryHistoryAndFields) {
  const Folder folder;
  const auto outcome =
      diptych(folder, "run swinging-cube-ve2-hex --level 1 --quiet --threads 1 --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  for (const char* method : {"sph", "fvm"}) {
    const auto directory = folder.path() / "out" / method;
    const auto summary = io::summary_from_json(text_of(directory / "summary.json"), method);
    EXPECT_EQ(summary.method, method);
    EXPECT_EQ(summary.nodes, 729);
    EXPECT_EQ(summary.status, "done");
    EXPECT_EQ(summary.errors.size(), 6u);  // v, u, F, P and, from F, H and J
    EXPECT_GT(summary.energy.viscous_dissipation, 0);
    EXPECT_GT(summary.energy.numerical_dissipation, 0);
    EXPECT_LT(std::abs(summary.energy.relative_residual), 1e-2);
    EXPECT_EQ(summary.state_hash.size(), 32u);
    const auto history = io::history_from_csv(text_of(directory / "history.csv"), method);
    EXPECT_EQ(history.size(), 11u);
    EXPECT_TRUE(std::filesystem::exists(directory / "run.hdf.series"));
    const auto u = io::read_field((directory / "frame_0010.hdf").string(), "displacement [m]");
    EXPECT_EQ(u.n_components, 3);
    EXPECT_EQ(u.values.size(), 3u * 729);
  }
}

TEST(Verbs, RunSaysWhatItsCaseAsksAndDoesNotHold) {
  const Folder folder;
  const std::string run =
      "run vibrating-bar --method fvm --quiet --no-fields --threads 1 --set time.end=0.002 ";
  const auto unmet = diptych(folder, run + "--out unmet --set 'expect.holds=[\"steps <= 1\"]'");
  EXPECT_EQ(unmet.exit_code, 5) << unmet.text;
  EXPECT_THAT(unmet.text,
              HasSubstr("diptych: fvm level 0 does not hold what the case asks: steps "));
  EXPECT_THAT(unmet.text, HasSubstr("status unmet"));
  const auto path = folder.path() / "unmet" / "fvm" / "summary.json";
  const auto summary = io::summary_from_json(text_of(path), "summary.json");
  EXPECT_EQ(summary.status, "unmet");
  EXPECT_THAT(summary.unmet, HasSubstr(", asked <= 1"));
  const auto met = diptych(folder, run + "--out met --set 'expect.holds=[\"steps >= 1\"]'");
  EXPECT_EQ(met.exit_code, 0) << met.text;
  const auto wrong = diptych(folder, run + "--out wrong --set 'expect.holds=[\"stepps <= 1\"]'");
  EXPECT_EQ(wrong.exit_code, 2) << wrong.text;
  EXPECT_THAT(wrong.text, HasSubstr("did you mean 'steps'?"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "wrong")) << "before anything is written";
}

TEST(Verbs, RunWarnsWhereCellsHaveTurnedInsideOut) {
  const Folder folder;
  const std::string run =
      "run twisting-column-400 --method fvm --set fvm.stencil=edge --quiet --no-fields --threads "
      "1 ";
  const auto folded =
      diptych(folder, run + "--level 1 --out folded --set time.end=0.06 --set output.frames=6");
  EXPECT_EQ(folded.exit_code, 3) << folded.text;
  EXPECT_THAT(folded.text, HasSubstr("WARNING: fvm level 1: from t = 0.05 s on cells are inside"));
  EXPECT_THAT(folded.text, HasSubstr("diptych: fvm level 1 is unsound: from t = 0.05 s on"));
  const auto path = folder.path() / "folded" / "fvm";
  const auto summary = io::summary_from_json(text_of(path / "summary.json"), "summary.json");
  EXPECT_EQ(summary.status, "unsound");
  EXPECT_DOUBLE_EQ(summary.end_time, 0.06);
  EXPECT_GT(summary.min_jacobian, 0.1) << "no node sees it";
  EXPECT_LT(summary.least_cell_J, 0);
  EXPECT_GT(summary.most_inverted_cells, 0);
  EXPECT_NEAR(summary.inverted_from.value_or(0), 0.05, 1e-12) << "the output time, to rounding";
  const auto history = io::history_from_csv(text_of(path / "history.csv"), "history.csv");
  EXPECT_EQ(history.front().least_cell_J, 1);
  EXPECT_GT(history[4].least_cell_J, 0);
  EXPECT_LT(history[5].least_cell_J, 0) << "the row of 0.05 s";
  const auto stopped =
      diptych(folder, run +
                          "--level 1 --out stopped --set time.end=0.06 --set output.frames=6 "
                          "--set guards.inverted_cells=stop");
  EXPECT_EQ(stopped.exit_code, 3) << stopped.text;
  EXPECT_THAT(stopped.text, HasSubstr("of 3072 cells are inside out"));
  const auto rows = io::history_from_csv(text_of(folder.path() / "stopped" / "fvm" / "history.csv"),
                                         "history.csv");
  ASSERT_EQ(rows.size(), 6u) << "four outputs after the first, and that of the last good state";
  EXPECT_LT(rows.back().time, 0.05);
  EXPECT_GT(rows.back().least_cell_J, 0);
  const auto failed = io::summary_from_json(
      text_of(folder.path() / "stopped" / "fvm" / "summary.json"), "summary.json");
  EXPECT_EQ(failed.status, "breakdown");
  ASSERT_TRUE(failed.failure && failed.failure->step);
  EXPECT_EQ(*failed.failure->step, failed.steps + 1) << "the step was taken back";
  EXPECT_EQ(failed.most_inverted_cells, 0);
  const auto sound = diptych(folder, run + "--out sound --set time.end=0.02");
  EXPECT_EQ(sound.text.find("WARNING"), std::string::npos) << sound.text;
}

TEST(Verbs, ProbesAreInHistorySummaryStepsAndFrames) {
  const Folder folder;
  const auto outcome = diptych(folder,
                               "run vibrating-bar --method fvm --quiet --threads 1 --out out --set "
                               "probe.0.every_step=true --set output.fields=true --set "
                               "output.frames=50");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("end displacement: "), HasSubstr("; period 0.193")));
  const auto directory = folder.path() / "out" / "fvm";
  const std::string history = text_of(directory / "history.csv");
  EXPECT_EQ(io::probe_names_from_csv(history, "history.csv"),
            std::vector<std::string>{"end displacement [m]"});
  const double last = io::history_from_csv(history, "history.csv").back().probes.at(0);
  const auto summary = io::summary_from_json(text_of(directory / "summary.json"), "summary.json");
  ASSERT_EQ(summary.quantities.size(), 1u);
  EXPECT_EQ(summary.quantities[0].final_value, last);
  EXPECT_NEAR(summary.quantities[0].period, 0.193064, 3e-4);  // 7e-4 measured at this level
  EXPECT_THAT(text_of(directory / "steps.csv"),
              testing::StartsWith("time [s],step,end displacement [m]\n0,0,0\n"));
  const auto frame = io::Hdf5File::open_for_reading((directory / "frame_0050.hdf").string());
  EXPECT_EQ(frame.read_doubles("/VTKHDF/FieldData/end displacement [m]"),
            std::vector<double>{last});
}

TEST(Verbs, SameCaseSameHashForOneAndTwoThreads) {
  const Folder folder;
  const auto hash = [&](const std::string& options) {
    const auto outcome = diptych(
        folder, "run swinging-cube-ve2-tet --level 1 --method fvm --quiet --no-fields " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    const size_t at = outcome.text.find("state ");
    return outcome.text.substr(at, 38);
  };
  EXPECT_EQ(hash("--threads 1 --out a"), hash("--threads 2 --out b"));
}

TEST(Verbs, CompareAndConvergeWriteAReport) {
  const Folder folder;
  const auto compared =
      diptych(folder, "compare swinging-cube-elastic-hex --quiet --threads 1 --out a");
  EXPECT_EQ(compared.exit_code, 0) << compared.text;
  EXPECT_THAT(compared.text, AllOf(HasSubstr("SPH"), HasSubstr("report.html")));
  const std::string page = text_of(folder.path() / "a" / "report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("<canvas"), HasSubstr("</html>")));
  const auto converged =
      diptych(folder, "converge swinging-cube-elastic-hex --levels 2 --quiet --threads 1 --out b");
  EXPECT_EQ(converged.exit_code, 0) << converged.text;
  EXPECT_THAT(converged.text, HasSubstr("ord."));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "b" / "report.html"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "b" / "level_1" / "sph" / "summary.json"));
}

TEST(Verbs, StudySetsErrorAgainstCost) {
  const Folder folder;
  const auto outcome = diptych(folder,
                               "study swinging-cube-elastic-hex --levels 2 --repeats 1 --quiet "
                               "--threads 1 --vary scheme.face_correction=0,1/6 --out out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("Gflop/s"), HasSubstr("seconds at equal error"),
                                  HasSubstr("SPH face_correction=1/6")));
  EXPECT_THAT(text_of(folder.path() / "out" / "work_precision.html"), HasSubstr("<canvas"));
  const std::string csv = text_of(folder.path() / "out" / "work_precision.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 2 * 2);
}

TEST(Verbs, StudyFindsStabilityLimits) {
  const Folder folder;
  const auto outcome = diptych(folder,
                               "study cable-smooth --stability --integrators leapfrog --quiet "
                               "--steps 200 --threads 1 --out out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("default/limit"), HasSubstr("leapfrog")));
  const std::string csv = text_of(folder.path() / "out" / "stability.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2);
}

TEST(Verbs, StudyTellsWhatLocalStepsWouldSave) {
  const Folder folder;
  const auto outcome =
      diptych(folder, "study l-block --local-steps --vary mesh.size=1,0.8 --out out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("dt ratio"), HasSubstr("size=0.8")));
  const std::string csv = text_of(folder.path() / "out" / "local_steps.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 2);
  EXPECT_EQ(diptych(folder, "study l-block --local-steps --stability").exit_code, 2);
}

TEST(Verbs, EveryShippedCaseIsListedAndSound) {
  const Folder folder;
  const auto list = diptych(folder, "list");
  ASSERT_EQ(list.exit_code, 0) << list.text;
  int n_cases = 0, n_meshed = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(tests::source_folder() + "/benchmarks/cases")) {
    if (!entry.is_directory()) continue;
    const std::string name = entry.path().filename().string();
    EXPECT_THAT(list.text, HasSubstr(name + " "));
    ++n_cases;
    // what is meshed by gmsh: the others are checked by Cases.AreSoundOnBothMethodsAndExplained
    if (text_of(entry.path() / "case.toml").find(".geo\"") == std::string::npos) continue;
    const auto check = diptych(folder, "check " + name + " --threads 1");
    EXPECT_EQ(check.exit_code, 0) << name << ": " << check.text;
    ++n_meshed;
  }
  EXPECT_GE(n_meshed, 10);
  EXPECT_GE(n_cases, 4);
}

TEST(Verbs, CommittedReferencePageIsTheOneThatTheProgramPrints) {
  const Folder folder;
  const auto page = diptych(folder, "explain all");
  EXPECT_EQ(page.exit_code, 0);
  EXPECT_EQ(page.text, text_of(tests::source_folder() + "/benchmarks/cases/KEYS.md"))
      << "refresh it: build/release/diptych explain all > benchmarks/cases/KEYS.md";
}

TEST(Readme, EveryCommandOfTheProgramWorks) {
  const Folder folder;
  const std::string readme = text_of(tests::source_folder() + "/README.md");
  const std::string program = "    build/release/diptych ";
  int n_commands = 0;
  for (size_t at = readme.find(program); at != std::string::npos;
       at = readme.find(program, at + 1)) {
    const size_t begin = at + program.size(), end = readme.find('\n', begin);
    const std::string arguments = readme.substr(begin, end - begin);
    const auto outcome = diptych(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.text;
    ++n_commands;
  }
  EXPECT_GE(n_commands, 5);
}

TEST(Readme, CaseOfYourOwnRunsWithBothMethods) {
  const Folder folder;
  const std::string readme = text_of(tests::source_folder() + "/README.md"), fence = "```toml\n";
  const size_t begin = readme.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const size_t from = begin + fence.size();
  std::ofstream(folder.path() / "strip.toml")
      << readme.substr(from, readme.find("```", from) - from);
  const auto outcome = diptych(folder, "compare strip.toml --threads 1 --quiet");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("tip displacement [m], final"), HasSubstr("report.html")));
}

}  // namespace
}  // namespace diptych
