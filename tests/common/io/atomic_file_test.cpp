/// A file is there whole or not at all, and the message names path and reason.

#include "common/io/atomic_file.hpp"

#include "common/base/error.hpp"
#include "common/io/run_record.hpp"
#include "tests/common/io/scratch.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace diptych::io {
namespace {

namespace fs = std::filesystem;
using base::EnvironmentError;
using test::message_of;
using test::Scratch;
using testing::AllOf;
using testing::HasSubstr;

TEST(AtomicFile, HoldsEveryByteAndLeavesNoOtherFile) {
  const Scratch folder;
  std::string text(300'000, '\0');
  for (size_t i = 0; i < text.size(); ++i)
    text[i] = static_cast<char>(i * 31);
  write_file_atomically(folder / "a", "old");
  write_file_atomically(folder / "a", text);
  EXPECT_EQ(read_file(folder / "a"), text);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(AtomicFile, ReplacesTheLeftoverOfAKilledRun) {
  const Scratch folder;
  std::ofstream(folder / "a.tmp") << "half";
  write_file_atomically(folder / "a", "whole");
  EXPECT_EQ(read_file(folder / "a"), "whole");
  EXPECT_FALSE(fs::exists(folder / "a.tmp"));
}

TEST(AtomicFile, DoesNotWriteThroughALinkPlantedInItsPlace) {
  const Scratch folder;
  write_file_atomically(folder / "victim", "mine");
  fs::create_symlink(folder / "victim", folder / "a.tmp");
  write_file_atomically(folder / "a", "new");
  EXPECT_EQ(read_file(folder / "victim"), "mine");
}

TEST(AtomicFile, SaysPathAndReason) {
  const Scratch folder;
  EXPECT_THAT(message_of<EnvironmentError>([&] { write_file_atomically(folder / "no/a", "x"); }),
              AllOf(HasSubstr("'" + (folder / "no/a") + "'"), HasSubstr("errno 2"),
                    HasSubstr("check that the folder exists")));
  EXPECT_THAT(message_of<EnvironmentError>([&] { read_file(folder / "b"); }), HasSubstr("errno 2"));
  EXPECT_THAT(message_of<EnvironmentError>([&] { read_file(folder.path()); }),
              HasSubstr("directory"));
  fs::create_directory(folder / "taken");
  EXPECT_THROW(write_file_atomically(folder / "taken", "x"), EnvironmentError);
  EXPECT_FALSE(fs::exists(folder / "taken.tmp"));
  write_file_atomically(folder / "file", "x");
  EXPECT_THROW(make_directory(folder / "file"), EnvironmentError);
}

TEST(AtomicFileDeathTest, AFullDiskKeepsTheOldFile) {
  const Scratch folder;
  const std::string path = folder / "a";
  write_file_atomically(path, "old");
  const auto write_too_much = [&path] {
    std::signal(SIGXFSZ, SIG_IGN);  // then write() says EFBIG, as ENOSPC on a full disk
    const rlimit limit{4096, 4096};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_file_atomically(path, std::string(100'000, 'x'));
    } catch (const EnvironmentError& error) {
      fputs(error.what(), stderr);
      std::exit(4);
    }
    std::exit(0);
  };
  EXPECT_EXIT(write_too_much(), testing::ExitedWithCode(4),
              "100000 bytes to .*errno 27.*free space");
  EXPECT_EQ(read_file(path), "old");
  EXPECT_FALSE(fs::exists(path + ".tmp"));
}

}  // namespace
}  // namespace diptych::io
