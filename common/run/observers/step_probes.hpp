#pragma once
/// The rows of steps.csv: probes with every_step, at t = 0 and after each step. Where they go to a
/// file, a kill leaves every row until the last output time, or until a second ago.
/// Test: tests/command_line/killed_test.cpp

#include "common/io/row_file.hpp"
#include "common/io/run_record.hpp"
#include "common/run/observers/observer.hpp"
#include "common/run/probes.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace diptych::run {

class StepProbes : public Observer {
 public:
  /// @param solver, probes  kept by reference
  StepProbes(Solver& solver, const Probes& probes) : solver_(solver), probes_(probes) {}

  /// The rows so far, and those from now on, go to this file too.
  /// @param columns  headers of these probes, see probe_columns
  /// @throws base::EnvironmentError
  void write_to(const std::string& path, const std::vector<std::string>& columns);

  void begin() override { after_step({}); }
  void after_step(const StepReport& step) override;
  /// The file has all rows until now.
  void at_output(const Output& output) override;
  /// The file is on the disk.
  void end(Ending ending) override;
  void archive(algebra::Archive& archive) override;

  const std::vector<io::StepRow>& rows() const { return rows_; }
  std::vector<io::StepRow> take_rows() { return std::move(rows_); }

 private:
  using Clock = std::chrono::steady_clock;
  void flush();

  Solver& solver_;
  const Probes& probes_;
  std::vector<io::StepRow> rows_;
  std::unique_ptr<io::RowFile> file_;
  Clock::time_point flushed_ = Clock::now();
};

}  // namespace diptych::run
