#pragma once
/// How many processors this process may keep busy: those that it may run on (taskset, cpusets) and
/// the share of them that its control groups leave it, as in a container or under a scheduler.
/// Test: tests/common/parallel/threads_test.cpp

#include <filesystem>
#include <string>

namespace diptych::parallel {

/// At least 1.
int available_processors();

/// Processors that the control groups of a process leave it, rounded up; 0 where there is no limit.
/// @param membership  text of /proc/PID/cgroup
/// @param root        of the hierarchies, /sys/fs/cgroup
int quota_of_groups(const std::string& membership, const std::filesystem::path& root);

}  // namespace diptych::parallel
