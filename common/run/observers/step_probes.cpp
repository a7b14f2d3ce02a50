#include "common/run/observers/step_probes.hpp"

namespace diptych::run {

void StepProbes::write_to(const std::string& path, const std::vector<std::string>& columns) {
  file_ = std::make_unique<io::RowFile>(path, io::steps_header(columns));
}

void StepProbes::after_step(const StepReport& step) {
  if (!probes_.has_stepped()) return;
  rows_.push_back({step.time, step.step, probes_.stepped_values(solver_)});
  if (!file_) return;
  file_->append(io::steps_line(rows_.back()));
  if (Clock::now() - flushed_ >= std::chrono::seconds(1)) flush();
}

void StepProbes::at_output(const Output&) {
  if (file_) flush();
}

void StepProbes::end(Ending) {
  if (file_) file_->finish();
}

void StepProbes::flush() {
  file_->flush();
  flushed_ = Clock::now();
}

}  // namespace diptych::run
