#include "benchmarks/harness/memory.hpp"

#include <fstream>
#include <malloc.h>
#include <string>
#include <unistd.h>

namespace diptych::harness {

std::int64_t peak_rss_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::stoll(line.substr(6)) * 1024;
  }
  return 0;
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
  const auto free = [](auto& array) { std::remove_reference_t<decltype(array)>().swap(array); };
  free(graph.row);
  free(graph.neighbour);
  free(graph.reverse);
  free(graph.C);
  graph.classes = {};
}

}  // namespace diptych::harness
