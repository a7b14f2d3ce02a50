#pragma once
/// The folder that a run writes into: taking it, and what stands in its summary.json from the
/// start of the run to its end, whatever ends it. Test: tests/command_line/killed_test.cpp

#include "benchmarks/run/run_case.hpp"

#include <string>

namespace diptych::harness {

class RunFolder {
 public:
  /// @param directory  empty: nothing is written
  explicit RunFolder(std::string directory) : directory_(std::move(directory)) {}

  bool is_written() const { return !directory_.empty(); }
  const std::string& path() const { return directory_; }

  /// Nothing stands there, or what an earlier run left (it has a summary.json).
  /// @throws base::InputError where it holds something else
  void check() const;
  /// Makes or takes the folder, leaves word that a run is under way, removes what the earlier run
  /// left, and puts a copy of the case there.
  /// @param goes_on  from a checkpoint: what was left is its own, and stays
  /// @throws base::EnvironmentError where it cannot
  void open(const cases::Case& setup, io::RunSummary summary, bool goes_on) const;
  /// What a run leaves besides its frames and rows; the summary last.
  void close(const RunResult& result) const;
  /// Another summary of the run that has ended there. @throws base::EnvironmentError
  void renew(const io::RunSummary& summary) const;
  /// The summary of a run that could not be finished, even where the disk is full. Never throws.
  void close_failed(const io::RunSummary& summary) const noexcept;

 private:
  std::string file(const char* name) const;
  std::string directory_;
};

/// Puts a copy of the case at the path, unless a case file of the user stands there.
/// @throws base::EnvironmentError
void write_case_copy(const std::string& path, const cases::Case& setup);

/// Whether a run of diptych has left its summary.json in this folder.
bool is_run_folder(const std::string& directory);

/// Removes what a run has left in its folder, the folder too where nothing else is in it. Files
/// of others stay. @throws base::EnvironmentError
void remove_run(const std::string& directory);

}  // namespace diptych::harness
