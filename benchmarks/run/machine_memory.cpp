#include "benchmarks/run/memory.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();

std::int64_t machine_bytes() {
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;) {
    std::int64_t kilobytes = 0;
    if (word == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
  }
  return no_limit;
}

/// One number of a file; `otherwise` where there is none ("max").
std::int64_t number_in(const fs::path& path, std::int64_t otherwise) {
  std::ifstream file(path);
  std::int64_t value = 0;
  return file >> value ? value : otherwise;
}

/// Files that are kept in memory but can be dropped count as used; they are not.
std::int64_t droppable(const fs::path& group) {
  std::ifstream file(group / "memory.stat");
  std::string name;
  for (std::int64_t value = 0; file >> name >> value;) {
    if (name == "inactive_file") return value;
  }
  return 0;
}

/// Of the group of the process and all above it (version 2).
std::int64_t control_group_bytes() {
  std::ifstream file("/proc/self/cgroup");
  std::int64_t least = no_limit;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("0::/", 0) != 0) continue;
    const fs::path root = "/sys/fs/cgroup";
    for (fs::path group = line.substr(4);; group = group.parent_path()) {
      const fs::path folder = group.empty() ? root : root / group;
      const std::int64_t most = number_in(folder / "memory.max", no_limit);
      if (most != no_limit) {
        const std::int64_t used = number_in(folder / "memory.current", 0) - droppable(folder);
        least = std::min(least, std::max<std::int64_t>(0, most - used));
      }
      if (group.empty()) break;
    }
  }
  return least;
}

std::int64_t address_space_bytes() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return no_limit;
  const std::int64_t pages = number_in("/proc/self/statm", 0);
  return std::max<std::int64_t>(
      0, static_cast<std::int64_t>(limit.rlim_cur) - pages * sysconf(_SC_PAGESIZE));
}

}  // namespace

AvailableMemory available_memory() {
  AvailableMemory least{machine_bytes(), "of this machine"};
  const auto take = [&](std::int64_t bytes, const char* limit) {
    if (bytes < least.bytes) least = {bytes, limit};
  };
  take(control_group_bytes(), "of its control group (memory.max)");
  take(address_space_bytes(), "of its address space (ulimit -v)");
  return least;
}

}  // namespace diptych::harness
