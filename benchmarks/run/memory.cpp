#include "benchmarks/run/memory.hpp"

#include <algorithm>
#include <fstream>
#include <malloc.h>
#include <string>
#include <unistd.h>

namespace diptych::harness {

namespace {

/// A line of /proc/self/status in bytes.
std::int64_t status_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) == 0) return std::stoll(line.substr(key.size())) * 1024;
  }
  return 0;
}

/// What the program itself has allocated; its code, which a first run brings in, is not among it.
std::int64_t allocated_memory() {
  malloc_trim(0);
  return status_bytes("RssAnon:");
}

}  // namespace

std::int64_t peak_rss_bytes() {
  return status_bytes("VmHWM:");
}

RunMemory::RunMemory() {
  static const std::int64_t before_the_first = allocated_memory();
  held_ = std::max<std::int64_t>(0, allocated_memory() - before_the_first);
  reset_peak_rss();
}

void reset_peak_rss() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::int64_t settled_memory() {
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  std::int64_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

void release_pairs(scheme::PairGraph& graph) {
  graph.slopes = {};
  const auto free = [](auto& array) { std::remove_reference_t<decltype(array)>().swap(array); };
  free(graph.row);
  free(graph.neighbour);
  free(graph.reverse);
  free(graph.C);
  graph.classes = {};
}

}  // namespace diptych::harness
