#pragma once
/// Memory that this process can still have. Test: tests/harness/memory_estimate_test.cpp

#include <cstdint>
#include <string>

namespace diptych::harness {

struct AvailableMemory {
  std::int64_t bytes = 0;
  std::string limit;  ///< what sets it: "of this machine", "of the control group", ...
};

/// The least of what the system can give without swapping (MemAvailable), what is left of the
/// control groups of the process (memory.max, as containers and schedulers set it), and what is
/// left of the limit of its address space (ulimit -v).
AvailableMemory available_memory();

}  // namespace diptych::harness
