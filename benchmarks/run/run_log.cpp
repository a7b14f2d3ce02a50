#include "benchmarks/run/run_log.hpp"

#include "benchmarks/run/quantities.hpp"

#include <filesystem>
#include <vector>

namespace diptych::harness {

namespace {

std::string path_in(const std::string& directory, const char* name) {
  return (std::filesystem::path(directory) / name).string();
}

}  // namespace

RunLog::RunLog(const std::string& directory, const cases::Case& setup)
    : history_(path_in(directory, "history.csv"), io::history_header(probe_columns(setup, false))) {
  const std::vector<std::string> stepped = probe_columns(setup, true);
  if (stepped.empty()) return;
  steps_ =
      std::make_unique<io::RowFile>(path_in(directory, "steps.csv"), io::steps_header(stepped));
}

void RunLog::row(const io::HistoryRow& row) {
  history_.append(io::history_line(row));
  history_.flush();
  if (!steps_) return;
  steps_->flush();
  flushed_ = Clock::now();
}

void RunLog::step(const io::StepRow& row) {
  steps_->append(io::steps_line(row));
  if (Clock::now() - flushed_ < std::chrono::seconds(1)) return;
  steps_->flush();
  flushed_ = Clock::now();
}

void RunLog::finish() {
  history_.finish();
  if (steps_) steps_->finish();
}

}  // namespace diptych::harness
