#include "benchmarks/run/output_folder.hpp"

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/checkpoints.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/run/run_folder.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/copy.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <initializer_list>
#include <optional>
#include <system_error>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

/// Folders in a folder, sorted; none where it cannot be read.
std::vector<fs::path> folders_in(const fs::path& directory) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_directory(error) && !entry->is_symlink(error)) folders.push_back(entry->path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

/// level_<L> folders of a folder.
std::vector<fs::path> level_folders(const fs::path& directory) {
  std::vector<fs::path> levels;
  for (const fs::path& folder : folders_in(directory)) {
    const std::string name = folder.filename().string();
    const bool is_level = name.starts_with("level_") && name.size() > 6 &&
                          name.find_first_not_of("0123456789", 6) == std::string::npos;
    if (is_level) levels.push_back(folder);
  }
  return levels;
}

std::optional<io::SummaryOwner> owner_of(const fs::path& run) {
  return io::summary_owner(io::read_file((run / "summary.json").string()));
}

/// Whether it holds the run of a variant; not so a copy of another run that the user has put there.
bool is_variant_folder(const fs::path& folder, const std::string& method) {
  const std::string name = folder.filename().string();
  return name.starts_with(method + "-") && is_run_folder(folder.string()) &&
         owner_of(folder)->column == name;
}

/// The folders of both methods that hold a run, and those of their variants.
std::vector<fs::path> runs_in(const fs::path& directory) {
  std::vector<fs::path> runs;
  const std::vector<fs::path> folders = folders_in(directory);
  for (const std::string& method : method_menu().names()) {
    if (is_run_folder((directory / method).string())) runs.push_back(directory / method);
    for (const fs::path& folder : folders) {
      if (is_variant_folder(folder, method)) runs.push_back(folder);
    }
  }
  return runs;
}

/// All folders of runs in the output folder of a command.
std::vector<fs::path> all_runs(const fs::path& directory) {
  std::vector<fs::path> all = runs_in(directory);
  const auto add = [&all](const std::vector<fs::path>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (const fs::path& above : {directory, directory / "earlier"}) {
    for (const fs::path& level : level_folders(above))
      add(runs_in(level));
  }
  for (const fs::path& run : folders_in(directory / "runs")) {
    if (is_run_folder(run.string())) all.push_back(run);
  }
  return all;
}

void remove_if_empty(const fs::path& folder) {
  std::error_code ignored;  // one that is not empty, or not there, stays as it is
  if (fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
}

[[noreturn]] void fail(const fs::path& path, const char* what, const std::error_code& error) {
  throw base::EnvironmentError(fmt::format("{}: results of an earlier run cannot be {}: {}",
                                           path.string(), what, error.message()));
}

/// Moves the finished run of `from` to `to`, in the place of what an earlier one left there.
void move_run(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (fs::exists(to, error)) remove_run(to.string());
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::rename(from, to, error);
  if (error) fail(from, "set aside", error);
}

/// Whether some command of diptych has put its results into this folder: a table or page there is
/// then its own, and not somebody else's of the same name.
bool is_output_folder(const fs::path& directory) {
  const fs::path copy = directory / "case.toml";
  std::error_code error;
  return !all_runs(directory).empty() ||
         (fs::is_regular_file(copy, error) && cases::is_case_copy(io::read_file(copy.string())));
}

bool contains(const std::vector<std::string>& paths, const fs::path& path) {
  return std::find(paths.begin(), paths.end(), path.string()) != paths.end();
}

bool has_status(const fs::path& run, std::initializer_list<const char*> statuses) {
  const std::string text = io::read_file((run / "summary.json").string());
  return std::any_of(statuses.begin(), statuses.end(), [&](const char* status) {
    return text.find(fmt::format("\"status\": \"{}\"", status)) != std::string::npos;
  });
}

bool is_finished(const fs::path& run) {
  return has_status(run, {"done", "unmet", "unsound"});
}

/// Interrupted or killed, with something to go on from: hours of work may be in it.
bool is_to_go_on(const fs::path& run) {
  if (!has_status(run, {"interrupted", "running"})) return false;
  const fs::directory_iterator files(run);
  return std::any_of(begin(files), end(files), [](const fs::directory_entry& file) {
    return is_checkpoint_name(file.path().filename().string());
  });
}

/// Without links; as it stands where they cannot be followed.
fs::path followed(const fs::path& path) {
  std::error_code error;
  fs::path result = fs::weakly_canonical(path, error);
  return error ? path : result;
}

/// Of the case that a run was of, as its file was then; nothing where the run has left none.
std::optional<std::string> text_of_case(const fs::path& run) {
  const fs::path copy = run / "case.toml";
  std::error_code error;
  if (!fs::is_regular_file(copy, error)) return std::nullopt;
  return cases::original_text(io::read_file(copy.string()));
}

/// Nothing where the run did not finish.
std::optional<int> finished_level(const fs::path& run) {
  const std::string summary = (run / "summary.json").string();
  try {
    const io::RunSummary s = io::summary_from_json(io::read_file(summary), summary);
    return s.is_ended() ? std::optional(s.level) : std::nullopt;
  } catch (const base::InputError&) {
    return std::nullopt;  // cut off, or of another version
  }
}

}  // namespace

OutputFolder::OutputFolder(std::string directory,
                           const cases::Case& setup,
                           OutputKind kind,
                           bool force,
                           const std::vector<std::string>& also)
    : directory_(std::move(directory)), setup_(setup), kind_(kind) {
  if (directory_.empty()) return;
  std::error_code error;
  if (fs::is_directory(directory_, error)) lock_.emplace(directory_);
  for (const fs::path& run : all_runs(directory_)) {
    const auto owner = owner_of(run);
    if (!owner) continue;
    if (is_of_this_case(run.string(), *owner, also)) continue;
    const std::string case_file = owner->case_file.empty() ? "" : " (" + owner->case_file + ")";
    if (kind_ == OutputKind::continued) {
      throw base::InputError(
          fmt::format("{}: holds results of another case, {}{}, whose text is not that of {}; "
                      "--restart goes on with those of its own case: give the --out that has them",
                      directory_, owner->case_name, case_file, setup.file));
    }
    of_another_case_ = true;
    if (force) return;
    throw base::InputError(fmt::format(
        "{}: holds results of another case, {}{}; give another --out, or --force to replace them",
        directory_, owner->case_name, case_file));
  }
}

/// A case is its file, by whatever path, or, where a run goes on, the text that it left beside its
/// results: its folder may have been moved or copied since.
bool OutputFolder::is_of_this_case(const std::string& run,
                                   const io::SummaryOwner& owner,
                                   const std::vector<std::string>& also) const {
  if (owner.case_file.empty()) return owner.case_name == setup_.name;
  const fs::path file = followed(owner.case_file);
  const auto is_that = [&](const std::string& other) { return followed(other) == file; };
  if (is_that(setup_.file) || std::any_of(also.begin(), also.end(), is_that)) return true;
  return kind_ == OutputKind::continued && text_of_case(run) == setup_.text;
}

void OutputFolder::prepare() {
  if (prepared_ || directory_.empty()) return;
  prepared_ = true;
  io::make_directory(directory_);
  if (!lock_) lock_.emplace(directory_);
  if (of_another_case_) remove_everything();
  if (is_output_folder(directory_)) remove_pages();
  const bool has_runs = kind_ == OutputKind::runs || kind_ == OutputKind::levels;
  if (has_runs) {
    remove_runs();
    set_levels_aside();
  }
  if (kind_ == OutputKind::atlas) return;  // of many cases
  write_case_copy((fs::path(directory_) / "case.toml").string(), setup_);
}

void OutputFolder::refuse_to_replace(bool force) const {
  if (force || kind_ == OutputKind::continued || directory_.empty()) return;
  std::vector<std::string> finished, to_go_on;
  const auto look_at = [&](const fs::path& run) {
    if (!is_run_folder(run.string()) || contains(taken_over_, run)) return;
    if (is_finished(run)) {
      finished.push_back(run.string());
    } else if (is_to_go_on(run)) {
      to_go_on.push_back(run.string());
    }
  };
  if (kind_ == OutputKind::runs) {
    for (const fs::path& run : runs_in(directory_))
      look_at(run);
  }
  for (const std::string& run : asked_)
    look_at(run);
  if (!to_go_on.empty()) {
    throw base::InputError(
        fmt::format("{}: a checkpoint of a run that did not finish; 'diptych run' with --restart "
                    "latest goes on "
                    "from there, --force begins anew and removes it",
                    base::joined(to_go_on)));
  }
  if (finished.empty()) return;
  throw base::InputError(fmt::format(
      "{}: {} finished; give another --out, or --force to replace what is there",
      base::joined(finished), finished.size() == 1 ? "is a run that" : "are runs that"));
}

void OutputFolder::remove_everything() const {
  const fs::path directory = directory_;
  for (const fs::path& run : all_runs(directory))
    remove_run(run.string());
  for (const fs::path& above : {directory, directory / "earlier"}) {
    for (const fs::path& level : level_folders(above))
      remove_if_empty(level);
  }
  remove_if_empty(directory / "earlier");
  remove_if_empty(directory / "runs");
  for (const char* name :
       {"report.html", "convergence.csv", "convergence.tex", "work_precision.csv",
        "work_precision.html", "quantities.csv", "quantities.html", "stability.csv",
        "local_steps.csv", "atlas.csv", "atlas.json", "atlas.html"}) {
    std::error_code error;
    fs::remove(directory / name, error);
    if (error) fail(directory / name, "removed", error);
  }
}

/// Tables and pages that this command writes itself, perhaps not today.
void OutputFolder::remove_pages() const {
  std::vector<const char*> names{"report.html", "convergence.csv", "convergence.tex"};
  if (kind_ == OutputKind::study)
    names = {"work_precision.csv", "work_precision.html", "quantities.csv", "quantities.html"};
  if (kind_ == OutputKind::stability) names = {"stability.csv"};
  if (kind_ == OutputKind::local_steps) names = {"local_steps.csv"};
  if (kind_ == OutputKind::atlas) names = {"atlas.csv", "atlas.json", "atlas.html"};
  for (const char* name : names) {
    const fs::path page = fs::path(directory_) / name;
    std::error_code error;
    fs::remove(page, error);
    if (error) fail(page, "removed", error);
  }
}

/// A study of levels sets aside what `run` or `compare` has finished, as one of its levels.
void OutputFolder::remove_runs() const {
  for (const fs::path& run : runs_in(directory_)) {
    const auto level = kind_ == OutputKind::levels ? finished_level(run) : std::nullopt;
    if (level) {
      move_run(run,
               fs::path(directory_) / "earlier" / fmt::format("level_{}", *level) / run.filename());
    } else {
      remove_run(run.string());
    }
  }
}

void OutputFolder::set_levels_aside() const {
  for (const fs::path& level : level_folders(directory_)) {
    for (const fs::path& run : runs_in(level)) {
      if (contains(taken_over_, run)) continue;
      if (is_finished(run) && !contains(asked_, run)) {
        move_run(run, fs::path(directory_) / "earlier" / level.filename() / run.filename());
      } else {
        remove_run(run.string());
      }
    }
    remove_if_empty(level);
  }
}

void OutputFolder::ask_for(const std::vector<int>& levels,
                           const std::vector<Column>& columns,
                           bool fresh) {
  if (directory_.empty()) return;
  const fs::path directory = directory_, earlier = directory / "earlier";
  for (const int level : levels) {
    const std::string name = fmt::format("level_{}", level);
    for (const Column& column : columns) {
      asked_.push_back((directory / name / column.name()).string());
      if (fresh) continue;
      RunOptions options;
      options.method = column.method;
      options.variant = column.variant;
      options.level = level;
      options.directory = (earlier / name / column.name()).string();
      if (finished_run(column.setup, options)) move_run(options.directory, asked_.back());
      options.directory = asked_.back();
      if (finished_run(column.setup, options)) taken_over_.push_back(asked_.back());
    }
    remove_if_empty(earlier / name);
  }
  remove_if_empty(earlier);
}

std::vector<std::string> runs_below(const std::string& directory) {
  std::vector<std::string> runs;
  for (const fs::path& run : all_runs(directory))
    runs.push_back(run.string());
  return runs;
}

}  // namespace diptych::harness
