/// Threads are as many as were asked for, or as the environment and the machine leave.

#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/parallel/processors.hpp"
#include "common/parallel/thread_count.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace diptych::parallel {
namespace {

namespace fs = std::filesystem;

/// A tree of control groups, gone afterwards.
class Groups : public testing::Test {
 protected:
  Groups() {
    std::string name = (fs::temp_directory_path() / "diptych-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    root = name;
  }
  ~Groups() override { fs::remove_all(root); }
  void set(const std::string& file, const std::string& text) const {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  }
  fs::path root;
};

TEST_F(Groups, WithoutALimitLeaveAllProcessors) {
  EXPECT_EQ(quota_of_groups("", root), 0);
  EXPECT_EQ(quota_of_groups("0::/a/b\n", root), 0);
  set("a/b/cpu.max", "max 100000\n");
  EXPECT_EQ(quota_of_groups("0::/a/b\n", root), 0);
  set("cpu,cpuacct/x/cpu.cfs_quota_us", "-1\n");
  set("cpu,cpuacct/x/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(quota_of_groups("4:memory:/x\n3:cpu,cpuacct:/x\n", root), 0);
}

TEST_F(Groups, LeaveTheLeastShareOfTheWayUpRoundedUp) {
  set("a/cpu.max", "150000 100000\n");
  set("a/b/cpu.max", "400000 100000\n");
  EXPECT_EQ(quota_of_groups("0::/a/b\n", root), 2);
  EXPECT_EQ(quota_of_groups("0::/a/b/c\n", root), 2) << "a group without a file of its own";
  set("cpu.max", "10000 100000\n");  // that of a container, whose root is its own group
  EXPECT_EQ(quota_of_groups("0::/\n", root), 1);
}

TEST_F(Groups, OfTheFirstVersionAreReadToo) {
  set("cpu,cpuacct/docker/1/cpu.cfs_quota_us", "300000\n");
  set("cpu,cpuacct/docker/1/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(quota_of_groups("5:cpuset:/docker/1\n3:cpu,cpuacct:/docker/1\n", root), 3);
}

TEST(ThreadCount, IsWhatWasAskedForWithinItsRange) {
  EXPECT_EQ(thread_count(1), 1);
  EXPECT_EQ(thread_count(3), 3);
  EXPECT_GE(thread_count(0), 1);
  EXPECT_LE(thread_count(0), available_processors());
  for (const int wrong : {-1, most_threads + 1, 1000000000})
    EXPECT_THROW(thread_count(wrong), base::InputError) << wrong;
}

TEST(ThreadCount, IsThatOfTheLoops) {
  for (const int n : {1, 2, 3}) {
    set_threads(n);
    EXPECT_EQ(running_threads(), n);
  }
  set_threads(0);
}

}  // namespace
}  // namespace diptych::parallel
