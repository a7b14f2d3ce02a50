/// How many threads run is what was asked for, or what the environment leaves.

#include "tests/command_line/small_case.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using tests::cube;
using tests::Folder;
using tests::shell;
using tests::summary_in;

TEST(Threads, AreThoseOfTheEnvironmentAndOfTheRange) {
  const Folder folder;
  folder.write("case.toml", cube + "[time]\nend = 1e-3\n[output]\nfields = false\n");
  const auto threads_with = [&](const std::string& before, const std::string& arguments) {
    const auto outcome =
        shell(folder, before + " $diptych run case.toml --method fvm --quiet --force " + arguments +
                          " --out out");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    return summary_in(folder.path() / "out" / "fvm").threads;
  };
  EXPECT_EQ(threads_with("OMP_NUM_THREADS=1", ""), 1);
  EXPECT_EQ(threads_with("OMP_THREAD_LIMIT=1", ""), 1);
  EXPECT_EQ(threads_with("taskset -c 0", ""), 1);
  EXPECT_EQ(threads_with("OMP_NUM_THREADS=1", "--threads 3"), 3);
  for (const char* wrong : {"-1", "1e9", "1000000000", "1025", "2.5", "two"}) {
    const auto outcome =
        tests::diptych(folder, std::string("run case.toml --threads ") + wrong + " --out out");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, AllOf(HasSubstr("--threads"), HasSubstr("0"), HasSubstr("1024")));
  }
  const auto limited =
      shell(folder, "OMP_THREAD_LIMIT=2 $diptych run case.toml --threads 3 --force --out out");
  EXPECT_EQ(limited.exit_code, 2) << limited.text;
  EXPECT_THAT(limited.text, HasSubstr("OMP_THREAD_LIMIT"));
}

TEST(Threads, SpinShortlyUnlessTheUserSaysOtherwise) {
  const Folder folder;
  const auto spin_with = [&](const std::string& before) {
    return shell(folder, "unset OMP_WAIT_POLICY; export OMP_DISPLAY_ENV=verbose; " + before +
                             " $diptych --version")
        .text;
  };
  EXPECT_THAT(spin_with(""), HasSubstr("GOMP_SPINCOUNT = '10000'"));
  EXPECT_THAT(spin_with("GOMP_SPINCOUNT=77"), HasSubstr("GOMP_SPINCOUNT = '77'"));
}

}  // namespace
}  // namespace diptych
