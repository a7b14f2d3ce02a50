/// Tables that grow while a run goes on.

#include "common/io/row_file.hpp"

#include "common/base/error.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"
#include "tests/common/io/scratch.hpp"

#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>

namespace diptych::io {
namespace {

using base::EnvironmentError;
using test::message_of;
using test::Scratch;
using testing::AllOf;
using testing::HasSubstr;

TEST(RowFile, HoldsWhatWasFlushedWhileItGrows) {
  const Scratch folder;
  const std::string path = folder / "history.csv";
  std::ofstream(path) << "of an earlier run";
  RowFile file(path, "a,b\n");
  EXPECT_EQ(read_file(path), "a,b\n");
  file.append("1,2\n");
  file.append("3,4\n");
  EXPECT_EQ(read_file(path), "a,b\n");
  file.flush();
  EXPECT_EQ(read_file(path), "a,b\n1,2\n3,4\n");
  file.append("5,6\n");
  file.finish();
  EXPECT_EQ(read_file(path), "a,b\n1,2\n3,4\n5,6\n");
}

TEST(RowFile, DoesNotFollowALinkPlantedInItsPlace) {
  const Scratch folder;
  std::ofstream(folder / "precious") << "years of work";
  std::filesystem::create_symlink(folder / "precious", folder / "history.csv");
  RowFile file(folder / "history.csv", "a\n");
  file.finish();
  EXPECT_EQ(read_file(folder / "precious"), "years of work");
  EXPECT_EQ(read_file(folder / "history.csv"), "a\n");
}

TEST(RowFile, SaysWhereItCannotBeMade) {
  const Scratch folder;
  const std::string path = folder / "no/such/history.csv";
  EXPECT_THAT(message_of<EnvironmentError>([&] { RowFile(path, "a\n"); }), HasSubstr(path));
}

/// What a child process says that may not make a file longer than `most` bytes.
std::string said_with_a_limit(rlim_t most,
                              const std::string& folder,
                              void (*work)(const Scratch&),
                              const Scratch& scratch) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{most, most};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::string said = "nothing was thrown";
    try {
      work(scratch);
    } catch (const base::Error& error) {
      said = error.what();
    }
    std::ofstream(folder + "/said") << said;
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  return read_file(folder + "/said");
}

TEST(RowFile, SaysThatTheDiskIsFull) {
  const Scratch folder;
  const auto work = [](const Scratch& scratch) {
    RowFile file(scratch / "history.csv", "a\n");
    for (int i = 0; i < 1000; ++i) {
      file.append("0123456789\n");
      file.flush();
    }
  };
  EXPECT_THAT(said_with_a_limit(4096, folder.path(), work, folder),
              AllOf(HasSubstr("history.csv"), HasSubstr("free space")));
  EXPECT_EQ(read_file(folder / "history.csv").size(), 4096u);
}

TEST(WriteOver, PutsALastWordInThePlaceOfALongerOne) {
  const Scratch folder;
  const auto work = [](const Scratch& scratch) {
    if (!write_over(scratch / "summary.json", "failed")) throw EnvironmentError("not written");
    try {
      write_file_atomically(scratch / "summary.json", std::string(100, 'x'));
    } catch (const EnvironmentError&) {
      throw EnvironmentError("no second file fits");
    }
  };
  std::ofstream(folder / "summary.json") << std::string(1000, 'r');
  EXPECT_EQ(said_with_a_limit(50, folder.path(), work, folder), "no second file fits");
  EXPECT_EQ(read_file(folder / "summary.json"), "failed");
  EXPECT_FALSE(write_over(folder / "not-there", "x"));
}

}  // namespace
}  // namespace diptych::io
