#include "benchmarks/run/resumption.hpp"

#include "benchmarks/run/provenance.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <filesystem>

namespace diptych::harness {

namespace fs = std::filesystem;

std::string input_hash(const cases::Case& setup, const std::vector<NodeMeasure>& measures) {
  std::string all = setup.hash;
  std::error_code error;
  if (fs::is_regular_file(setup.mesh.file, error)) all += io::read_file(setup.mesh.file);
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
  } catch (const base::InputError&) {
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

}  // namespace diptych::harness
