#pragma once
/// Memory of the process as the system counts it (Linux) and what it can still have. Tests:
/// tests/harness/memory_test.cpp, tests/harness/memory_estimate_test.cpp

#include <cstdint>
#include <string>

namespace diptych::harness {

/// Largest resident set since the last reset, bytes.
std::int64_t peak_rss_bytes();
void reset_peak_rss();

/// Resident set after what has been freed has gone back to the system, bytes.
std::int64_t settled_memory();

/// Memory of one run of a program that may make several: without what earlier ones still hold, such
/// as a state at the end that is to be compared with. Test: tests/harness/memory_test.cpp
class RunMemory {
 public:
  /// The run begins here.
  RunMemory();
  /// Largest resident set since, bytes.
  std::int64_t peak() const { return peak_rss_bytes() - held_; }
  /// Resident set now, bytes.
  std::int64_t settled() const { return settled_memory() - held_; }

 private:
  std::int64_t held_;  ///< by earlier runs
};

struct AvailableMemory {
  std::int64_t bytes = 0;
  std::string limit;  ///< what sets it: "of this machine", "of the control group", ...
};

/// The least of what the system can give without swapping (MemAvailable), what is left of the
/// control groups of the process (memory.max, as containers and schedulers set it), and what is
/// left of the limit of its address space (ulimit -v).
AvailableMemory available_memory();

}  // namespace diptych::harness
