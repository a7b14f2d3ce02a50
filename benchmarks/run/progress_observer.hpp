#pragma once
/// The progress of a run on the standard error stream (benchmarks/terminal/progress.hpp).

#include "benchmarks/run/run_case.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "common/run/observers/history.hpp"

#include <fmt/format.h>
#include <optional>

namespace diptych::harness {

class ProgressObserver : public run::Observer {
 public:
  /// Keeps all three by reference.
  ProgressObserver(const cases::Case& setup, const RunOptions& options, const run::History& history)
      : setup_(setup), options_(options), history_(history) {}

  void begin() override {
    progress_.emplace(fmt::format("{} level {}", options_.column(), options_.level),
                      setup_.time.end, options_.quiet, options_.schedule);
  }
  void resume() override {
    begin();
    goes_on_ = true;
  }
  void archive(algebra::Archive& archive) override {
    archive.integer("progress/rejected", rejected_);
  }
  void after_step(const run::StepReport& step) override {
    rejected_ += step.rejected;
    if (goes_on_) progress_->begin_at(step.time - step.dt);
    goes_on_ = false;
    if (progress_->due())
      progress_->show(step.time, step.step, step.dt, history_.energy_residual(), rejected_);
  }
  void end(run::Ending) override { progress_.reset(); }

 private:
  const cases::Case& setup_;
  const RunOptions& options_;
  const run::History& history_;
  std::optional<Progress> progress_;
  std::int64_t rejected_ = 0;
  bool goes_on_ = false;  // with the next step, from a checkpoint
};

}  // namespace diptych::harness
