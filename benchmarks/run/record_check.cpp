#include "benchmarks/run/record_check.hpp"

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/checkpoints.hpp"
#include "benchmarks/run/output_folder.hpp"
#include "common/base/error.hpp"
#include "common/io/checkpoint_file.hpp"
#include "common/io/checksums.hpp"
#include "common/io/field_writer.hpp"
#include "common/io/run_record.hpp"
#include "common/io/sealed_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <set>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

class Checker {
 public:
  explicit Checker(fs::path directory) : directory_(std::move(directory)) {}

  RecordCheck take() {
    note_faults([this] { summary(); });
    note_faults([this] { texts(); });
    note_faults([this] { rows(); });
    note_faults([this] { frames(); });
    folder();
    return std::move(check_);
  }

 private:
  std::string file(const std::string& name) const { return (directory_ / name).string(); }
  bool has(const std::string& name) const {
    std::error_code error;
    return fs::is_regular_file(directory_ / name, error);
  }
  void note_faults(const std::function<void()>& part) {
    try {
      part();
    } catch (const base::InputError& error) {
      check_.faults.emplace_back(error.what());
    }
  }

  void summary() {
    summary_ = io::summary_from_json(io::read_file(file("summary.json")), file("summary.json"));
    check_.status = summary_.status;
    check_.steps = summary_.steps;
  }

  /// A run that ended, however it did, left checksums of what is text.
  void texts() {
    if (has(io::checksums_file)) {
      for (std::string& fault : io::changed_files(directory_.string()))
        check_.faults.push_back(std::move(fault));
      return;
    }
    const bool is_over = !check_.status.empty() && check_.status != "running";
    if (is_over && check_.status != "failed")
      check_.faults.push_back(file(io::checksums_file) + ": is missing");
  }

  /// As its summary says, where that can be read.
  bool has_ended() const { return !check_.status.empty() && summary_.is_ended(); }

  void rows() {
    if (!has("history.csv")) {
      if (has_ended()) check_.faults.push_back(file("history.csv") + ": is missing");
      return;
    }
    const auto rows = io::history_from_csv(io::read_file(file("history.csv")), file("history.csv"));
    check_.rows = static_cast<int>(rows.size());
    const bool ascends =
        std::adjacent_find(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
          return !(a.time < b.time);
        }) == rows.end();
    if (!ascends) check_.faults.push_back(file("history.csv") + ": times do not ascend");
    if (has_ended() && (rows.empty() || rows.back().time != summary_.end_time)) {
      check_.faults.push_back(fmt::format("{}: does not end at t = {:g} s, as the run did",
                                          file("history.csv"), summary_.end_time));
    }
  }

  void frames() {
    if (!has("run.hdf.series")) return;
    note_faults([this] { io::read_sealed_file(file("mesh.hdf")); });
    std::set<std::string> named;
    for (const io::FrameEntry& frame : io::read_series(file("run.hdf.series"))) {
      named.insert(fs::path(frame.path).filename().string());
      note_faults([&] {
        if (!has(fs::path(frame.path).filename().string()))
          throw base::InputError(frame.path + ": is missing");
        io::read_sealed_file(frame.path);
        ++check_.frames;
      });
    }
  }

  void folder() {
    for (const auto& entry : fs::directory_iterator(directory_)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".tmp")) {
        check_.notes.push_back(entry.path().string() +
                               ": was being written when the run was ended");
      } else if (is_checkpoint_name(name)) {
        note_faults([&] {
          const io::CheckpointReader whole(entry.path().string());
          ++check_.checkpoints;
        });
      }
    }
    if (check_.status == "running") check_.notes.push_back("the run did not come to its end");
    std::sort(check_.faults.begin(), check_.faults.end());
  }

  fs::path directory_;
  io::RunSummary summary_;
  RecordCheck check_;
};

}  // namespace

std::vector<std::string> records_in(const std::string& directory) {
  const auto is_record = [](const fs::path& run) {
    std::error_code error;
    return fs::is_regular_file(run / io::checksums_file, error) ||
           (fs::is_regular_file(run / "summary.json", error) &&
            fs::is_regular_file(run / "history.csv", error));
  };
  if (is_record(directory)) return {directory};
  std::set<std::string> records;
  for (std::string& run : runs_below(directory))
    records.insert(std::move(run));
  for (const std::string& method : method_menu().names()) {
    const fs::path run = fs::path(directory) / method;
    if (is_record(run)) records.insert(run.string());
  }
  return {records.begin(), records.end()};
}

RecordCheck check_record(const std::string& directory) {
  return Checker(directory).take();
}

}  // namespace diptych::harness
