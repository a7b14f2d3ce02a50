#include "benchmarks/run/run_folder.hpp"

#include "benchmarks/run/checkpoints.hpp"
#include "common/base/error.hpp"
#include "common/cases/copy.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/checksums.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <set>
#include <system_error>
#include <vector>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

/// Room in summary.json for a message that is longer than what stood there while the run went on:
/// blanks, which JSON allows. On a full disk the last word is written in the same place.
constexpr size_t room_for_a_message = 4096;

/// Whether a run makes a file of this name in its folder.
bool is_of_a_run(std::string name) {
  static const std::set<std::string> names{"summary.json",  "history.csv",   "steps.csv",
                                           "exact.csv",     "case.toml",     "mesh.hdf",
                                           "checksums.txt", "run.hdf.series"};
  if (name.ends_with(".tmp")) name.resize(name.size() - 4);
  if (names.count(name) > 0 || is_checkpoint_name(name)) return true;
  const bool is_frame = name.starts_with("frame_") && name.ends_with(".hdf") && name.size() >= 14;
  return is_frame && name.find_first_not_of("0123456789", 6) == name.size() - 4;
}

/// A file of the name of a copy that is none.
bool is_case_of_the_user(const fs::path& path) {
  return path.filename() == "case.toml" && !cases::is_case_copy(io::read_file(path.string()));
}

/// What a run has left, in the order in which it may go: without its history a run is not taken
/// over, and without its summary the folder is no longer known as one of a run.
std::vector<fs::path> left_by_a_run(const fs::path& directory, std::error_code& error) {
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (is_of_a_run(name) && !is_case_of_the_user(entry->path())) files.push_back(entry->path());
  }
  const auto rank = [](const fs::path& path) {
    return path.filename() == "history.csv" ? 0 : path.filename() == "summary.json" ? 2 : 1;
  };
  std::sort(files.begin(), files.end(),
            [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return files;
}

/// @param except  the name of a file that stays
void remove_files(const fs::path& directory, const std::string& except) {
  std::error_code error;
  for (const fs::path& file : left_by_a_run(directory, error)) {
    if (file.filename() != except) fs::remove(file, error);
    if (error) break;
  }
  if (error) {
    throw base::EnvironmentError(
        directory.string() + ": what an earlier run left cannot be removed: " + error.message());
  }
}

/// Whether there is anything else than what a run leaves whose first file was cut off.
bool holds_more_than_a_beginning(const fs::path& directory, std::error_code& error) {
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().filename() != "summary.json.tmp") return true;
  }
  return false;
}

}  // namespace

std::string RunFolder::file(const char* name) const {
  return (fs::path(directory_) / name).string();
}

void RunFolder::check() const {
  std::error_code error;
  const fs::path path = directory_;
  if (!is_written()) return;
  if (fs::is_symlink(path, error)) {
    throw base::InputError(directory_ +
                           ": is a link: results would lie elsewhere; give another --out");
  }
  if (!fs::exists(path, error)) return;
  if (!fs::is_directory(path, error)) {
    throw base::InputError(directory_ + ": is not a folder; give another --out");
  }
  if (!fs::exists(path / "summary.json", error) && holds_more_than_a_beginning(path, error)) {
    throw base::InputError(directory_ +
                           ": holds files that no run of diptych made; give another --out");
  }
}

void RunFolder::open(const cases::Case& setup, io::RunSummary summary, bool goes_on) const {
  if (!is_written()) return;
  io::make_directory(directory_);
  summary.status = "running";
  io::write_file_atomically(file("summary.json"),
                            io::to_json(summary) + std::string(room_for_a_message, ' ') + "\n");
  if (!goes_on) remove_files(directory_, "summary.json");
  std::error_code ignored;  // of texts that change now
  fs::remove(file(io::checksums_file), ignored);
  write_case_copy(file("case.toml"), setup);
}

void RunFolder::close(const RunResult& result) const {
  if (!is_written()) return;
  if (!result.exact.empty())
    io::write_file_atomically(file("exact.csv"), io::columns_csv(result.exact));
  renew(result.summary);
}

void RunFolder::renew(const io::RunSummary& summary) const {
  std::error_code ignored;
  fs::remove(file(io::checksums_file), ignored);  // of a text that changes now
  io::write_file_atomically(file("summary.json"), io::to_json(summary));
  std::vector<std::string> texts{"summary.json", "history.csv", "steps.csv", "exact.csv",
                                 "run.hdf.series"};
  if (!is_case_of_the_user(file("case.toml"))) texts.emplace_back("case.toml");
  io::write_checksums(directory_, texts);
}

void RunFolder::close_failed(const io::RunSummary& summary) const noexcept {
  if (!is_written()) return;
  try {
    const std::string path = file("summary.json"), text = io::to_json(summary);
    try {
      io::write_file_atomically(path, text);
    } catch (const base::EnvironmentError&) {
      std::error_code ignored;
      if (!io::write_over(path, text)) fs::remove(path, ignored);  // better no word than "running"
    }
  } catch (const std::exception&) {
    // no memory for a few lines: the error that ends the run is told on the terminal
  }
}

void write_case_copy(const std::string& path, const cases::Case& setup) {
  std::error_code error;
  if (fs::exists(path, error) && is_case_of_the_user(path)) return;
  io::write_file_atomically(path, cases::case_copy(setup));
}

bool is_run_folder(const std::string& directory) {
  const fs::path summary = fs::path(directory) / "summary.json";
  std::error_code error;
  if (!fs::is_regular_file(summary, error)) return false;
  return io::summary_owner(io::read_file(summary.string())).has_value();
}

void remove_run(const std::string& directory) {
  remove_files(directory, "");
  std::error_code error;
  if (fs::is_empty(directory, error)) fs::remove(directory, error);
}

}  // namespace diptych::harness
