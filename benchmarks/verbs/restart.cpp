#include "benchmarks/verbs/restart.hpp"

#include "benchmarks/run/checkpoints.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/run/run_identity.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>

namespace diptych::verbs {

namespace {

namespace fs = std::filesystem;

void tell(const std::string& notice) {
  std::fputs(fmt::format("diptych: {}\n", notice).c_str(), stderr);
}

/// Whether the same program has finished this run of the study before.
bool is_finished(const cases::Case& setup,
                 const harness::StudyOptions& options,
                 const std::string& method) {
  harness::RunOptions run;
  run.method = method;
  run.level = options.levels.front();
  run.directory = (fs::path(options.directory) / method).string();
  return harness::finished_run(setup, run).has_value();
}

void go_on_from_latest(const cases::Case& setup, harness::StudyOptions& options) {
  std::vector<std::string> without, folders;
  bool has_any = false;
  for (const std::string& method : options.methods) {
    folders.push_back((fs::path(options.directory) / method).string());
    if (is_finished(setup, options, method)) {
      has_any = true;
      continue;
    }
    const harness::FoundCheckpoint found = harness::latest_checkpoint(folders.back());
    for (const std::string& reason : found.refused)
      tell(reason + "; an earlier checkpoint is taken");
    if (found.path) {
      has_any = true;
      options.checkpoints[method] = *found.path;
    } else {
      without.push_back(folders.back());
    }
  }
  if (!has_any) {
    throw base::InputError(
        fmt::format("there is no checkpoint in {}; time.checkpoint_every, time.checkpoint_seconds "
                    "and time.checkpoint_interval have them "
                    "written, and Ctrl-C of a run does",
                    base::joined(folders)));
  }
  for (const std::string& folder : without)
    tell(fmt::format("there is no checkpoint in {}: this run begins at t = 0", folder));
  options.resume = true;
}

void go_on_from(const std::string& file, bool has_folder, harness::StudyOptions& options) {
  if (!fs::is_regular_file(file))
    throw base::InputError(fmt::format("--restart {}: there is no such file", file));
  const std::string method = harness::identity_in(file).method;
  if (std::count(options.methods.begin(), options.methods.end(), method) == 0) {
    throw base::InputError(fmt::format("{}: is of method {}, --method asks for {}", file, method,
                                       base::joined(options.methods)));
  }
  options.methods = {method};
  const fs::path folder = fs::weakly_canonical(file).parent_path();
  if (!has_folder) options.directory = folder.parent_path().string();
  const fs::path wanted = fs::weakly_canonical(fs::path(options.directory) / method);
  if (folder != wanted) {
    throw base::InputError(fmt::format(
        "{}: lies in {}, the run in {}; a run goes on in its own folder, DIR/{} of --out DIR", file,
        folder.string(), wanted.string(), method));
  }
  options.checkpoints[method] = file;
}

}  // namespace

void go_on(const cases::Case& setup,
           const std::string& restart,
           bool has_folder,
           harness::StudyOptions& options) {
  if (restart.empty()) return;
  options.goes_on = true;
  if (restart == "latest") {
    go_on_from_latest(setup, options);
  } else {
    go_on_from(restart, has_folder, options);
  }
}

}  // namespace diptych::verbs
