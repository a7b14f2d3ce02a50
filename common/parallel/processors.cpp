#include "common/parallel/processors.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sched.h>
#include <sstream>
#include <thread>

namespace diptych::parallel {

namespace {

namespace fs = std::filesystem;

double number_in(const fs::path& file) {
  std::ifstream stream(file);
  double value = 0;
  return stream >> value ? value : 0;
}

/// quota / period of one group: "max 100000" or "150000 100000" (version 2), or two files
/// (version 1); 0 where it has no limit.
double share_of(const fs::path& group) {
  double quota = 0, period = 0;
  if (std::ifstream stream(group / "cpu.max"); stream) {
    if (!(stream >> quota >> period)) return 0;  // "max" is no number
  } else {
    quota = number_in(group / "cpu.cfs_quota_us");  // -1: none
    period = number_in(group / "cpu.cfs_period_us");
  }
  return quota > 0 && period > 0 ? quota / period : 0;
}

/// Of a group and those that it stands in, the least share; 0 where none has a limit.
double least_share(const fs::path& root, fs::path group) {
  double least = 0;
  for (;; group = group.parent_path()) {
    const double share = share_of(root / group.relative_path());
    if (share > 0 && (least == 0 || share < least)) least = share;
    if (!group.has_relative_path()) return least;
  }
}

/// Whether "cpu" stands in "cpu,cpuacct".
bool has_cpu(const std::string& controllers) {
  std::istringstream words(controllers);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "cpu") return true;
  }
  return false;
}

}  // namespace

int quota_of_groups(const std::string& membership, const fs::path& root) {
  double least = 0;
  std::istringstream lines(membership);
  for (std::string line; std::getline(lines, line);) {  // "0::/path" or "3:cpu,cpuacct:/path"
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && !has_cpu(controllers)) continue;
    const fs::path group = line.substr(second + 1);
    if (group.is_relative()) continue;
    const double share = least_share(root / controllers, group);
    if (share > 0 && (least == 0 || share < least)) least = share;
  }
  return static_cast<int>(std::ceil(least));
}

int available_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  int n = sched_getaffinity(0, sizeof allowed, &allowed) == 0
              ? CPU_COUNT(&allowed)
              : static_cast<int>(std::thread::hardware_concurrency());
  std::ifstream file("/proc/self/cgroup");
  const std::string membership{std::istreambuf_iterator<char>(file), {}};
  const int quota = quota_of_groups(membership, "/sys/fs/cgroup");
  if (quota > 0) n = std::min(n, quota);
  return std::max(n, 1);
}

}  // namespace diptych::parallel
