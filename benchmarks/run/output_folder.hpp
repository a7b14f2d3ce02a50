#pragma once
/// The output folder of a command: whose results lie in it, and what of them goes before new ones
/// are written, so that nothing of an earlier run is ever taken for a part of this one. Only what
/// diptych itself has made is touched. Test: tests/command_line/output_folder_test.cpp

#include "benchmarks/run/columns.hpp"
#include "common/cases/case.hpp"
#include "common/io/folder_lock.hpp"
#include "common/io/run_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

/// What a command is about to put there.
enum class OutputKind {
  runs,         ///< of `run` and `compare`: DIR/<column>, report.html
  continued,    ///< of `run --restart`: runs of DIR/<column> stay, whatever came of them
  levels,       ///< of `converge`: DIR/level_<L>/<column>, convergence.*, report.html
  study,        ///< of `study`: DIR/runs, work_precision.*
  stability,    ///< of `study --stability`: stability.csv
  local_steps,  ///< of `study --local-steps`: local_steps.csv
  atlas         ///< of `study --atlas`: DIR/runs, atlas.*
};

class OutputFolder {
 public:
  /// @param setup  kept by reference
  /// @param force  whether results of another case may be replaced; never those to go on from
  /// @param also   files of other cases whose runs belong to the command
  /// @throws base::InputError where results of another case lie there and are not to be replaced,
  /// or another process writes there
  OutputFolder(std::string directory,
               const cases::Case& setup,
               OutputKind kind,
               bool force,
               const std::vector<std::string>& also = {});

  /// Of a convergence study: its runs are these. Those that are finished stay where they are, and
  /// are brought back from where they were set aside, unless all are to be run again.
  /// @throws base::EnvironmentError
  void ask_for(const std::vector<int>& levels, const std::vector<Column>& columns, bool fresh);

  /// Before the first file is written; later calls do nothing. Removes what earlier commands of
  /// this kind left, sets finished levels aside that are not taken over now, in DIR/earlier, and
  /// leaves a copy of the case in DIR/case.toml, unless a case file of the user stands there or the
  /// command is of many cases (atlas). Of another case everything goes.
  /// @throws base::EnvironmentError
  void prepare();

  /// Of runs and levels. @throws base::InputError where a finished run would be replaced, and
  /// `force` is false
  void refuse_to_replace(bool force) const;

 private:
  bool is_of_this_case(const std::string& run,
                       const io::SummaryOwner& owner,
                       const std::vector<std::string>& also) const;
  void remove_everything() const;
  void remove_pages() const;
  void remove_runs() const;
  void set_levels_aside() const;

  std::string directory_;
  const cases::Case& setup_;
  OutputKind kind_;
  std::vector<std::string> asked_, taken_over_;  ///< folders of runs
  bool of_another_case_ = false, prepared_ = false;
  std::optional<io::FolderLock> lock_;  ///< as soon as the folder is there, until the end
};

/// The folders of all runs in the output folder of a command; empty where it is none.
std::vector<std::string> runs_below(const std::string& directory);

}  // namespace diptych::harness
