/// One process at a time has a folder, and nobody once that one has ended, however it did.

#include "common/io/folder_lock.hpp"

#include "common/base/error.hpp"
#include "tests/common/io/scratch.hpp"

#include <csignal>
#include <filesystem>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

namespace diptych::io {
namespace {

using test::message_of;
using testing::AllOf;
using testing::HasSubstr;

TEST(FolderLock, IsTakenOnceAndGoesWithItsFile) {
  const test::Scratch folder;
  const std::string path = folder / "";
  EXPECT_FALSE(lock_holder(path).has_value());
  {
    const FolderLock lock(path);
    EXPECT_THAT(lock_holder(path).value_or(""), HasSubstr("process " + std::to_string(getpid())));
    EXPECT_THAT(message_of<base::InputError>([&] { const FolderLock second(path); }),
                AllOf(HasSubstr(std::to_string(getpid())), HasSubstr("give another --out")));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / lock_file));
  const FolderLock again(path);
}

TEST(FolderLock, OfAProcessThatWasKilledIsNone) {
  const test::Scratch folder;
  const std::string path = folder / "";
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(path);
    kill(getpid(), SIGKILL);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_TRUE(std::filesystem::exists(folder / lock_file)) << "what it left";
  EXPECT_FALSE(lock_holder(path).has_value());
  const FolderLock lock(path);
  EXPECT_TRUE(lock_holder(path).has_value());
}

TEST(FolderLock, ThatCannotBeMadeIsAnErrorOfTheMachine) {
  const test::Scratch folder;
  EXPECT_THROW(FolderLock(folder / "nowhere"), base::EnvironmentError);
}

}  // namespace
}  // namespace diptych::io
