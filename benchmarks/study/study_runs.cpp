#include "benchmarks/study/study_runs.hpp"

#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/provenance.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/run/run_case.hpp"
#include "benchmarks/terminal/status_line.hpp"
#include "common/base/error.hpp"
#include "common/base/interruption.hpp"
#include "common/base/text.hpp"
#include "common/cases/reader.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/parallel/thread_count.hpp"
#include "postprocess/report/orders.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <optional>

namespace diptych::harness {

namespace {

/// A run that was finished before, whose times are those of this machine.
std::optional<io::RunSummary> timed_before(const cases::Case& setup, const RunOptions& options) {
  const auto finished = finished_run(setup, options);
  if (!finished) return std::nullopt;
  const io::RunSummary& run = finished->summary;
  const bool same = run.threads == parallel::running_threads() &&
                    run.provenance.cpu == provenance(setup.hash).cpu;
  return same ? std::optional(run) : std::nullopt;
}

/// A run of a curve, in the order in which they are made.
struct RunTurn {
  int level, repetition;
  size_t curve;
};

std::vector<RunTurn> turns_of(const StudyRequest& request, size_t n_curves) {
  std::vector<RunTurn> turns;
  for (int level = request.level; level < request.level + request.n_levels; ++level) {
    for (int repetition = 0; repetition < request.repeats; ++repetition) {
      for (size_t curve = 0; curve < n_curves; ++curve)
        turns.push_back({level, repetition, curve});
    }
  }
  return turns;
}

void add_to_curve(const io::RunSummary& run, const cases::Case& setup, WorkCurve& curve) {
  if (curve.points.empty() || curve.points.back().run.level != run.level) {
    curve.points.push_back({run, run.loop_seconds, run.loop_seconds, setup.scheme.face_correction});
    return;
  }
  WorkPoint& point = curve.points.back();
  point.most = std::max(point.most, run.loop_seconds);
  if (run.loop_seconds < point.least) {
    point.least = run.loop_seconds;
    point.run = run;
  }
}

/// The field to show: the one asked for, or the first of the case.
std::string field_of(const StudyRequest& request, const io::RunSummary& run) {
  const std::vector<std::string> fields = report::fields_of({run});
  if (request.field.empty()) return fields.at(0);
  if (std::find(fields.begin(), fields.end(), request.field) == fields.end()) {
    throw base::InputError("--field " + request.field + " is not measured" +
                           base::suggestion(request.field, fields));
  }
  return request.field;
}

/// Makes the runs one by one.
class Runner {
 public:
  Runner(const StudyRequest& request,
         const std::vector<cases::Case>& cases,
         std::vector<PlannedRun> planned,
         OutputFolder& output,
         StudyRuns& runs)
      : request_(request),
        cases_(cases),
        schedule_(std::move(planned)),
        output_(output),
        runs_(runs),
        status_(request.quiet) {
    options_.threads = request.threads;
    options_.fields = false;
    options_.quiet = request.quiet;
    options_.schedule = &schedule_;
    parallel::set_threads(request.threads);  // timings of earlier runs are of as many
    // of an exact solution the first run tells whether what was asked makes sense: nothing is
    // written before
    is_checked_ = !has_exact(cases.front());
    if (is_checked_) output.prepare();
  }

  /// @return false after an interrupt
  bool take(const RunTurn& turn) {
    WorkCurve& curve = runs_.curves[turn.curve];
    const cases::Case& setup = cases_[turn.curve / request_.methods.size()];
    options_.method = curve.method;
    options_.level = turn.level;
    if (is_checked_) options_.directory = directory_of(setup, turn);
    status_.show(fmt::format("{} level {}, repetition {} of {}", curve.name(), turn.level,
                             turn.repetition + 1, request_.repeats));
    const auto before = request_.fresh ? std::nullopt : timed_before(setup, options_);
    if (before) ++n_taken_over_;
    const io::RunSummary run = before ? *before : attempt_case(setup, options_).summary;
    if (interrupt_requested()) return false;
    check_field(run);
    if (run.status == "breakdown") {
      schedule_.finish(std::nullopt);
      if (turn.repetition == 0) add_breakdown(run, curve.variant);
    } else {
      schedule_.finish(run.wall_seconds);
      add_to_curve(run, setup, curve);
    }
    return true;
  }

  void tell_of_level(int level) {
    status_.keep(fmt::format("level {} done: {} runs, {} of them taken over", level,
                             request_.repeats * static_cast<int>(runs_.curves.size()),
                             n_taken_over_));
    n_taken_over_ = 0;
  }

 private:
  std::string directory_of(const cases::Case& setup, const RunTurn& turn) const {
    const std::filesystem::path runs = std::filesystem::path(request_.directory) / "runs";
    return (runs / fmt::format("{}_{}_level_{}_{}", input_hash(setup, {}), options_.method,
                               turn.level, turn.repetition + 1))
        .string();
  }

  void check_field(const io::RunSummary& run) {
    if (is_checked_) return;
    runs_.field = field_of(request_, run);
    output_.prepare();
    is_checked_ = true;
  }

  void add_breakdown(const io::RunSummary& run, const std::string& variant) {
    runs_.breakdowns.push_back(breakdown_of(run));
    std::string& message = runs_.breakdowns.back().message;
    if (!variant.empty()) message = variant + ": " + message;
  }

  const StudyRequest& request_;
  const std::vector<cases::Case>& cases_;
  Schedule schedule_;
  OutputFolder& output_;
  StudyRuns& runs_;
  StatusLine status_;
  RunOptions options_;
  bool is_checked_ = false;
  int n_taken_over_ = 0;
};

}  // namespace

bool has_exact(const cases::Case& setup) {
  return setup.motion || setup.exact.displacement || setup.exact.velocity;
}

StudyRuns runs_of_study(const StudyRequest& request,
                        const std::vector<Variant>& variants,
                        const std::vector<cases::Case>& cases,
                        OutputFolder& output) {
  StudyRuns runs;
  for (const Variant& variant : variants) {
    for (const std::string& method : request.methods)
      runs.curves.push_back({variant.label, method, {}});
  }
  const std::vector<RunTurn> turns = turns_of(request, runs.curves.size());
  std::vector<PlannedRun> planned;
  for (const RunTurn& turn : turns) {
    const WorkCurve& curve = runs.curves[turn.curve];
    planned.push_back({curve.name(), curve.method, turn.level,
                       cases::dimension_of(cases[turn.curve / request.methods.size()].mesh)});
  }
  Runner runner(request, cases, std::move(planned), output, runs);
  try {
    for (size_t i = 0; i < turns.size(); ++i) {
      if (!runner.take(turns[i])) break;
      if (i + 1 == turns.size() || turns[i + 1].level != turns[i].level)
        runner.tell_of_level(turns[i].level);
    }
  } catch (const base::Interruption&) {
    // while a mesh was made: what was finished before stands
  }
  runs.curves.erase(std::remove_if(runs.curves.begin(), runs.curves.end(),
                                   [](const WorkCurve& curve) { return curve.points.empty(); }),
                    runs.curves.end());
  return runs;
}

}  // namespace diptych::harness
