#include "benchmarks/run/memory.hpp"

#include "common/parallel/pages.hpp"

#include <algorithm>
#include <fstream>
#include <malloc.h>

namespace diptych::harness {

namespace {

/// What the program itself has allocated; its code, which a first run brings in, is not among it.
std::int64_t allocated_memory() {
  malloc_trim(0);
  return parallel::status_bytes("RssAnon:");
}

}  // namespace

std::int64_t peak_rss_bytes() {
  return parallel::status_bytes("VmHWM:");
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
  return parallel::settled_bytes();
}

}  // namespace diptych::harness
