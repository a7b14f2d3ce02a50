/// New baselines: at what size a case is recorded, and the record.

#include "benchmarks/regression/verb.hpp"
#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_check.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/provenance.hpp"
#include "benchmarks/run/run_case.hpp"
#include "benchmarks/terminal/output.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "common/base/error.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// A case that is run after every change: more than this asks for a size that somebody has chosen.
constexpr double longest_by_default = 60;  // s
/// A pair in a stage on one core, and stages of a step, both about (benchmarks/README.md).
constexpr double seconds_a_pair = 1.5e-8, stages_a_step = 3;

/// Of both methods on levels 0 and 1: half the spacing is 2^d as many pairs and twice the steps.
void check_affordable(const ListedCase& entry) {
  const cases::Case setup = harness::read_case(entry.file);
  const double finer = 1 + std::pow(2.0, cases::dimension_of(setup.mesh) + 1);
  double seconds = 0;
  std::int64_t steps = 0;
  for (const std::string& method : method_menu().names()) {
    const CaseCheck check = check_case(setup, method, 0, 0);
    seconds += finer * stages_a_step * seconds_a_pair * static_cast<double>(check.pairs) *
               static_cast<double>(check.steps);
    steps = std::max(steps, check.steps);
  }
  if (seconds <= longest_by_default) return;
  throw base::InputError(fmt::format(
      "{}: as it stands, on levels 0 and 1, it would take some {} of one core ({} steps on level "
      "0): too long for a check of every change; give the size, such as --set time.end={:.2g} (100 "
      "steps or so), or --levels 2 to record it as it stands",
      entry.name, duration_text(seconds), steps,
      100 * setup.time.end / static_cast<double>(steps)));
}

}  // namespace

RegressBaseline blessed_size(const RegressRequest& request,
                             const ListedCase& entry,
                             RegressBaseline recorded) {
  const bool is_first = recorded.methods.empty();
  if (!request.set.empty()) recorded.set = request.set;
  if (request.levels != 0) {
    recorded.levels = request.levels;
    recorded.one_level_because = request.one_level_because;
  } else if (is_first) {
    recorded.levels = 2;
    if (request.set.empty()) check_affordable(entry);
  }
  recorded.case_name = entry.name;
  return recorded;
}

RegressBaseline record_of(RegressBaseline size,
                          const RegressMeasurement& now,
                          const std::string& why) {
  const io::Provenance p = provenance("");
  size.reason = why;
  size.commit = p.commit;
  size.date = p.date;
  size.platform = this_platform();
  size.methods.clear();
  for (const auto& [method, measurement] : now.methods)
    size.methods[method] = measurement.figures;
  size.disagreement.clear();
  for (const auto& [name, figure] : now.agreement) {
    if (figure.excess() > 1) size.disagreement[name] = figure.excess();
  }
  return size;
}

RegressBaseline recorded(const RegressRequest& request,
                         const RegressBaseline& old,
                         const RegressBaseline& size,
                         const RegressMeasurement& now) {
  for (const auto& [method, measurement] : now.methods) {
    if (!measurement.failure.empty()) {
      throw base::Error(measurement.failure_code,
                        fmt::format("{} {}: {}; nothing is recorded", size.case_name, method,
                                    measurement.failure));
    }
  }
  RegressBaseline record = record_of(size, now, request.why);
  const std::string text = to_json(record);  // before anything is said of it
  const std::string path = baseline_path(request, size.case_name);
  print(fmt::format("{}  output: {}\n", difference_text(old, record), path));
  io::make_directory(baselines_folder(request.baselines_folder));
  io::write_file_atomically(path, text);
  return record;
}

}  // namespace diptych::harness
