#include "benchmarks/run/resumption.hpp"

#include "benchmarks/run/provenance.hpp"
#include "benchmarks/run/run_folder.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/run/references.hpp"
#include "meshes/geo/geo_scan.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace diptych::harness {

namespace fs = std::filesystem;

namespace {

/// steps.csv of a run, without rows where nothing is held against them.
/// @throws base::InputError, base::EnvironmentError
std::vector<io::StepRow> steps_in(const std::string& directory, const cases::Case& setup) {
  const bool is_needed =
      !setup.references.empty() && std::any_of(setup.probes.begin(), setup.probes.end(),
                                               [](const auto& probe) { return probe.every_step; });
  if (!is_needed) return {};
  const fs::path path = fs::path(directory) / "steps.csv";
  const auto columns = io::columns_from_csv(io::read_file(path.string()), path.string());
  std::vector<io::StepRow> rows(columns.at(0).values.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].time = columns[0].values[i];
    for (size_t k = 2; k < columns.size(); ++k)  // behind the number of the step
      rows[i].probes.push_back(columns[k].values[i]);
  }
  return rows;
}

/// What the file of a mesh says, with all that it takes in. Where it may not be read the run says
/// so.
std::string text_of_mesh(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "";
  if (fs::path(path).extension() != ".geo") return io::read_file(path);
  std::string all;
  try {
    for (const std::string& file : meshes::files_read(path)) {
      const std::string text = io::read_file(file);
      all += fmt::format("{} {} ", fs::relative(file, fs::path(path).parent_path()).string(),
                         text.size()) +
             text;
    }
  } catch (const base::InputError&) {
    return io::read_file(path);
  }
  return all;
}

}  // namespace

std::string input_hash(const cases::Case& setup, const std::vector<NodeMeasure>& measures) {
  std::string all = setup.hash;
  all += text_of_mesh(setup.mesh.file);
  for (const NodeMeasure& measure : measures)
    all += '\0' + measure.text;
  return cases::case_hash(all, {});
}

std::optional<RunResult> finished_run(const cases::Case& setup,
                                      const RunOptions& options,
                                      bool broken_down) {
  if (options.directory.empty()) return std::nullopt;
  const fs::path summary = fs::path(options.directory) / "summary.json";
  const fs::path history = fs::path(options.directory) / "history.csv";
  std::error_code error;
  if (!fs::exists(summary, error) || !fs::exists(history, error)) return std::nullopt;
  RunResult run;
  try {
    run.summary = io::summary_from_json(io::read_file(summary.string()), summary.string());
    run.history = io::history_from_csv(io::read_file(history.string()), history.string());
    const std::string exact = (fs::path(options.directory) / "exact.csv").string();
    if (fs::exists(exact, error)) run.exact = io::columns_from_csv(io::read_file(exact), exact);
    run.steps = steps_in(options.directory, setup);
  } catch (const base::Error&) {
    return std::nullopt;  // of another version, or cut off: the run is made again
  }
  const io::RunSummary& s = run.summary;
  const bool same = s.column() == options.column() && s.level == options.level &&
                    s.provenance.input_hash == input_hash(setup, options.measures) &&
                    s.provenance.program == program_hash();
  const bool ended = s.is_ended() || (broken_down && s.status == "breakdown");
  if (!same || !ended || run.history.empty()) return std::nullopt;
  return run;
}

void renew_references(const cases::Case& setup, const std::string& directory, RunResult& run) {
  if (setup.references.empty()) return;
  const std::string before = io::to_json(run.summary);
  run.summary.references = run::references_of(setup, run.history, run.steps);
  if (io::to_json(run.summary) != before) RunFolder(directory).renew(run.summary);
}

}  // namespace diptych::harness
