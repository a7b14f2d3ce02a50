#pragma once
/// Whether what a run has left is whole: its summary, rows, frames and checkpoints are as they were
/// written. Test: tests/command_line/record_check_test.cpp

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::harness {

struct RecordCheck {
  std::string status;  ///< of the summary; empty where it cannot be read
  std::int64_t steps = 0;
  int rows = 0, frames = 0, checkpoints = 0;
  std::vector<std::string> faults;  ///< path and what is wrong with it
  std::vector<std::string> notes;   ///< what is no fault and worth knowing
  bool is_whole() const { return faults.empty(); }
};

/// The folders of runs in a folder, or the folder itself, damaged summaries or not; empty where
/// there are none.
std::vector<std::string> records_in(const std::string& directory);

/// Of one run. @param directory  DIR/<method>  @throws base::EnvironmentError
RecordCheck check_record(const std::string& directory);

}  // namespace diptych::harness
