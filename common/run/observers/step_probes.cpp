#include "common/run/observers/step_probes.hpp"

namespace diptych::run {

void StepProbes::write_to(const std::string& path, const std::vector<std::string>& columns) {
  file_ = std::make_unique<io::RowFile>(path, io::steps_header(columns));
  for (const io::StepRow& row : rows_)
    file_->append(io::steps_line(row));
  file_->flush();
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

void StepProbes::archive(algebra::Archive& archive) {
  const size_t n_columns = 1 + probes_.n_stepped();
  std::vector<double> values;
  std::vector<std::int64_t> steps;
  for (const io::StepRow& row : rows_) {
    values.push_back(row.time);
    values.insert(values.end(), row.probes.begin(), row.probes.end());
    steps.push_back(row.step);
  }
  archive.integers("steps/steps", steps);
  archive.reals("steps/rows", "as steps.csv", values, static_cast<int>(n_columns),
                static_cast<std::int64_t>(steps.size()));
  rows_.resize(steps.size());
  for (size_t k = 0; k < rows_.size(); ++k) {
    const auto row = values.begin() + static_cast<std::ptrdiff_t>(k * n_columns);
    rows_[k] = {*row, steps[k], {row + 1, row + static_cast<std::ptrdiff_t>(n_columns)}};
  }
}

void StepProbes::flush() {
  file_->flush();
  flushed_ = Clock::now();
}

}  // namespace diptych::run
