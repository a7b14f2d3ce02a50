#pragma once
/// history.csv and steps.csv of a run, written while it goes on: a kill leaves every row until the
/// last output time, or until a second ago. Test: tests/command_line/killed_test.cpp

#include "common/cases/case.hpp"
#include "common/io/row_file.hpp"
#include "common/io/run_record.hpp"

#include <chrono>
#include <memory>
#include <string>

namespace diptych::harness {

class RunLog {
 public:
  /// @throws base::EnvironmentError
  RunLog(const std::string& directory, const cases::Case& setup);

  /// At an output time: handed to the system with all steps before it.
  void row(const io::HistoryRow& row);
  /// After a step; handed to the system about once a second.
  void step(const io::StepRow& row);
  /// At the end of the run: on the disk.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  io::RowFile history_;
  std::unique_ptr<io::RowFile> steps_;  ///< where the case has probes of every step
  Clock::time_point flushed_ = Clock::now();
};

}  // namespace diptych::harness
