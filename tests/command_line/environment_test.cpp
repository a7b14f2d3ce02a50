/// Where a run is started in an odd or hostile place it gives the same state, or one message with
/// code 4 (2 for a place that the user can change), and never ends without a word.

#include "tests/command_line/small_case.hpp"
#include "tests/trials.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::Folder;
using tests::Outcome;
using tests::shell;

/// A place: what is typed around the run, "$run" being the run into the folder `out`.
struct Place {
  const char* name;
  const char* line;
  int code;
  const char* message;  ///< empty where the run is to end as ever
};

class HostileEnvironment : public testing::TestWithParam<Place> {};

TEST_P(HostileEnvironment, GivesTheSameStateOrIsTold) {
  const Folder folder;
  folder.write("case.toml", tests::cube + "[time]\nend = 1e-2\n" + tests::probes);
  const std::string run = "run=\"$diptych run $PWD/case.toml --method fvm --threads 1 --quiet\"\n";
  ASSERT_EQ(shell(folder, run + "$run --out usual").exit_code, 0);
  const Place& place = GetParam();
  tests::Trials trials("hostile environments");
  const Outcome outcome = shell(folder, run + place.line);
  EXPECT_EQ(outcome.exit_code, place.code) << outcome.text;
  if (place.code == 0) {
    EXPECT_EQ(tests::summary_in(folder.path() / "out/fvm").state_hash,
              tests::summary_in(folder.path() / "usual/fvm").state_hash);
  } else {
    EXPECT_THAT(outcome.text, HasSubstr(place.message));
  }
  trials.add(!HasFailure());
}

const Place places[] = {
    {"TurkishLocale", "LC_ALL=tr_TR.UTF-8 LANG=de_DE $run --out out", 0, ""},
    {"OddTimeZone", "TZ=:/nonsense $run --out out", 0, ""},
    {"NoEnvironmentAtAll", "env -i $run --out out", 0, ""},
    {"NothingAtTheStandardStreams", "$run --out out <&- >/dev/null 2>/dev/null", 0, ""},
    {"NoRightsForNewFiles", "(umask 777; $run --out out); code=$?; chmod -R u+rwX out; exit $code",
     geteuid() == 0 ? 0 : 4, "Permission denied"},
    {"AFolderThatIsGone", "mkdir gone; out=$PWD/out; cd gone; rmdir ../gone; $run --out $out", 0,
     ""},
    {"StackOfAHundredKilobytes", "ulimit -s 100; $run --out out", 4, "ulimit -s"},
    {"ThreadsWithStacksOfThirtyKilobytes", "OMP_STACKSIZE=30k $run --out out", 4,
     "OMP_STACKSIZE=30k is too small"},
    {"ThreadsWithStacksOfAMegabyte", "OMP_STACKSIZE=' 1 M' $run --out out", 0, ""},
    {"StackOfAMegabyte", "ulimit -s 1024; $run --out out", 0, ""},
    {"FilesOfEightKilobytes", "ulimit -f 8; $run --out out", 4, "File too large"},
    {"FourOpenFiles",
     "for f in 3 4 5 6 7 8 9; do eval \"exec $f>&-\"; done; ulimit -n 5; $run --out out", 4,
     "Too many open files"},
    {"LittleAddressSpace", "ulimit -v 400000; $run --level 5 --out out", 4, "ulimit -v"},
    {"NoRoomForSixtyThreads",
     "ulimit -v 450000; $diptych run $PWD/case.toml --method fvm --threads 64 --out out", 4,
     "of 64 threads"},
    {"OneProcessor", "taskset -c 0 $run --out out", 0, ""},
    {"NameOfFourThousandLetters", "$run --out $(printf 'x%.0s' $(seq 4096))", 4, "name too long"},
    {"FolderThatTakesNoFiles", "$run --out /proc/self/out", 4, "cannot make the folder"},
    {"ResultsThatAreALink", "mkdir out; ln -s /tmp out/fvm; $run --out out", 2, "is a link"},
    {"FolderThatIsADeadLink", "ln -s nowhere out; $run --out out", 4,
     "'out' is a link to 'nowhere', which is not there"},
    {"NoTemporaryFolder", "TMPDIR=/nowhere $run --out out", 0, ""},
};

INSTANTIATE_TEST_SUITE_P(All, HostileEnvironment, testing::ValuesIn(places), [](const auto& one) {
  return std::string(one.param.name);
});

}  // namespace
}  // namespace diptych
