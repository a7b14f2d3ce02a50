#include "benchmarks/harness/run_folder.hpp"

#include "benchmarks/harness/quantities.hpp"
#include "common/base/error.hpp"

#include <filesystem>
#include <system_error>

namespace diptych::harness {

void claim_directory(const std::string& directory) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path path = directory;
  if (fs::exists(path, error)) {
    if (!fs::is_directory(path, error)) {
      throw base::InputError(directory + ": is not a folder; give another --out");
    }
    if (!fs::is_empty(path, error) && !fs::exists(path / "summary.json")) {
      throw base::InputError(directory +
                             ": holds files that no run of diptych made; give another --out");
    }
  }
  fs::create_directories(path, error);
  if (error) {
    throw base::EnvironmentError(directory + ": cannot be created: " + error.message());
  }
}

/// Leaves word that a run is under way here: until it is over, no one takes what lies in its folder
/// for a result.
void announce(const RunOptions& options, io::RunSummary summary) {
  if (options.directory.empty()) return;
  summary.status = "running";
  io::write_file_atomically((std::filesystem::path(options.directory) / "summary.json").string(),
                            io::to_json(summary));
}

void write_record(const run::Case& setup, const RunOptions& options, const RunResult& result) {
  if (options.directory.empty()) return;
  const std::filesystem::path directory = options.directory;
  io::write_file_atomically((directory / "history.csv").string(),
                            io::history_csv(result.history, probe_columns(setup, false)));
  std::filesystem::remove(directory / "exact.csv");  // of an earlier run of another case
  if (!result.exact.empty()) {
    io::write_file_atomically((directory / "exact.csv").string(), io::columns_csv(result.exact));
  }
  const std::vector<std::string> stepped = probe_columns(setup, true);
  if (!stepped.empty()) {
    io::write_file_atomically((directory / "steps.csv").string(),
                              io::steps_csv(result.steps, stepped));
  }
  io::write_file_atomically((directory / "summary.json").string(), io::to_json(result.summary));
}

}  // namespace diptych::harness
