/// Long runs: progress with the time left; Ctrl-C and SIGTERM end the step, leave what there is and
/// say how to go on. timeout(1) signals the program and its group: one request.

#include "common/io/run_record.hpp"
#include "tests/command_line/program.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>
#include <regex>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::Folder;
using tests::text_of;

/// The program under `before`, from inside the folder.
tests::Outcome under(const Folder& folder,
                     const std::string& before,
                     const std::string& arguments) {
  return tests::diptych(folder, "list > /dev/null; cd " + folder.path().string() + "; " + before +
                                    " " + tests::build_folder() + "/diptych " + arguments);
}

// an hour of steps; none of the tests waits for it
const std::string endless =
    " swinging-cube-ve2-hex --level 2 --threads 1 --set time.end=100 --out out";

TEST(Interrupt, EndsTheStepWritesWhatThereIsAndSaysHowToGoOn) {
  for (const char* signal : {"INT", "TERM"}) {
    const Folder folder;
    const auto outcome = under(folder, std::string("timeout --preserve-status -s ") + signal + " 4",
                               "run" + endless + " --method fvm");
    EXPECT_EQ(outcome.exit_code, 130) << outcome.text;
    EXPECT_THAT(outcome.text, AllOf(HasSubstr("interrupted; what had been computed is in out"),
                                    HasSubstr("with --restart latest the same command goes on")));
    const auto directory = folder.path() / "out" / "fvm";
    const auto summary = io::summary_from_json(text_of(directory / "summary.json"), signal);
    EXPECT_EQ(summary.status, "interrupted");
    EXPECT_GT(summary.steps, 0);
    EXPECT_GT(summary.end_time, 0);
    const auto history = io::history_from_csv(text_of(directory / "history.csv"), signal);
    EXPECT_EQ(history.back().time, summary.end_time);
    EXPECT_TRUE(std::filesystem::exists(directory / "frame_0001.hdf"));
    // a log: a line after two seconds
    EXPECT_TRUE(std::regex_search(
        outcome.text, std::regex("fvm level 2 +0 %  step \\d+  dt .* left  energy residual")))
        << outcome.text;
    EXPECT_THAT(outcome.text, Not(HasSubstr("\r")));
    // the same command again would begin anew, and remove what there is to go on from
    const auto again = under(folder, "timeout 4", "run" + endless + " --method fvm");
    EXPECT_EQ(again.exit_code, 2) << again.text;
    EXPECT_THAT(again.text, AllOf(HasSubstr("out/fvm: a checkpoint of a run that did not finish"),
                                  HasSubstr("--restart latest"), HasSubstr("--force")));
    EXPECT_EQ(io::summary_from_json(text_of(directory / "summary.json"), signal).steps,
              summary.steps);
  }
}

TEST(Interrupt, TellsTheTimeLeftOnATerminal) {
  const Folder folder;
  const auto outcome =
      under(folder, "timeout --foreground --preserve-status -s INT 4 script -qec \"",
            "run" + endless + " --method fvm\" /dev/null");
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("\r\033[Kfvm level 2"), HasSubstr(" left  ")));
  for (size_t at = outcome.text.find('\r'); at != std::string::npos;
       at = outcome.text.find('\r', at + 1)) {
    const size_t end = outcome.text.find_first_of("\r\n", at + 1);
    EXPECT_LE(std::min(end, outcome.text.size()) - at, 104u) << "wider than a terminal";
  }
}

TEST(Interrupt, LeavesAStudyThatGoesOn) {
  const Folder folder;
  // the first levels take a fraction of a second, the last minutes
  const std::string arguments =
      "converge swinging-cube-ve2-hex --levels 4 --level 0 --threads 1 --quiet --out out";
  const auto first = under(folder, "timeout --preserve-status -s TERM 4", arguments);
  EXPECT_EQ(first.exit_code, 130) << first.text;
  EXPECT_THAT(first.text, HasSubstr("finished runs are kept in out"));
  EXPECT_THAT(first.text, HasSubstr("ord.")) << "the finished levels are shown";
  const auto second = under(folder, "timeout --preserve-status -s TERM 4", arguments);
  EXPECT_THAT(second.text, HasSubstr("taken over, not run again: out/level_0/sph"));
}

TEST(Study, TakesOverTheTimedRunsOfAnEarlierOne) {
  const Folder folder;
  const std::string arguments =
      "study swinging-cube-elastic-hex --levels 2 --repeats 2 --threads 1 --out out";
  const auto first = tests::diptych(folder, arguments);
  ASSERT_EQ(first.exit_code, 0) << first.text;
  EXPECT_THAT(first.text, HasSubstr("level 1 done: 4 runs, 0 of them taken over"));
  const std::string csv = text_of(folder.path() / "out" / "work_precision.csv");
  const auto second = tests::diptych(folder, arguments);
  EXPECT_EQ(second.exit_code, 0) << second.text;
  // but for the very first run, which is made to see what the case measures
  EXPECT_THAT(second.text, AllOf(HasSubstr("level 0 done: 4 runs, 3 of them taken over"),
                                 HasSubstr("level 1 done: 4 runs, 4 of them taken over")));
  const auto level_1 = [](const std::string& text) {
    return text.substr(text.rfind("\"\",fvm,1,"));
  };
  EXPECT_EQ(level_1(text_of(folder.path() / "out" / "work_precision.csv")), level_1(csv));
  EXPECT_THAT(tests::diptych(folder, arguments + " --fresh").text,
              HasSubstr("level 1 done: 4 runs, 0 of them taken over"));
}

}  // namespace
}  // namespace diptych
