/// The jail of the mesher, tried with a shell in it: what the search of the .geo file might miss
/// can neither write outside its folder nor start a program.

#include "meshes/geo/jail.hpp"

#include "meshes/geo/child_program.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace diptych::meshes {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class JailTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "diptych_jail_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    fs::create_directories(folder_ / "own");
    std::ofstream(folder_ / "outside") << "before\n";
  }
  void TearDown() override { fs::remove_all(folder_); }
  ChildResult shell(const std::string& commands, bool is_alone = true) const {
    const Jail jail((folder_ / "own").string(), is_alone);
    return run_child("/bin/sh", {"-c", commands}, {{"HOME=/nowhere"}, false, &jail});
  }
  std::string outside() const { return bytes_of_file((folder_ / "outside").string()); }

  fs::path folder_;
};

TEST_F(JailTest, RunsInItsOwnFolderAndWritesThere) {
  const ChildResult result = shell("echo made > here; read line < here; echo \"$line $HOME\"; pwd");
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("made /nowhere\n"));
  EXPECT_THAT(result.output, HasSubstr(fs::canonical(folder_ / "own").string()));
  EXPECT_EQ(bytes_of_file((folder_ / "own/here").string()), "made\n");
}

TEST_F(JailTest, StartsNoOtherProgram) {
  // `exec` would stay in the jail; what a mesher can do is to start another process
  const ChildResult result = shell("/bin/echo started; (echo forked); echo end");
  EXPECT_THAT(result.output, testing::Not(HasSubstr("started")));
  EXPECT_THAT(result.output, testing::Not(HasSubstr("forked")));
  EXPECT_THAT(shell("/bin/echo started", false).output, HasSubstr("started")) << "a script may";
}

TEST_F(JailTest, WritesNothingOutside) {
  if (syscall(444, nullptr, 0, 1) < 1) GTEST_SKIP() << "this kernel has no Landlock";
  for (const bool is_alone : {true, false}) {
    const ChildResult result = shell("echo hurt > ../outside; echo hurt > ../new", is_alone);
    EXPECT_NE(result.exit_status, 0);
    EXPECT_EQ(outside(), "before\n");
    EXPECT_FALSE(fs::exists(folder_ / "new"));
  }
  shell("/bin/rm -f ../outside; /bin/mv ../outside .; /bin/mkdir ../made", false);
  EXPECT_EQ(outside(), "before\n");
  EXPECT_FALSE(fs::exists(folder_ / "made"));
  EXPECT_EQ(shell("echo x > /dev/null").exit_status, 0);
}

TEST_F(JailTest, LimitsHold) {
  EXPECT_THAT(shell("ulimit -t; ulimit -c").output, HasSubstr("7200\n0\n"));
}

TEST_F(JailTest, FolderThatIsNotThereIsAnError) {
  const Jail jail((folder_ / "none").string(), true);
  EXPECT_THROW(run_child("/bin/sh", {"-c", ":"}, {{}, false, &jail}), base::EnvironmentError);
}

}  // namespace
}  // namespace diptych::meshes
