/// The runs of a study.

#include "benchmarks/campaign/campaign.hpp"
#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/study/refinement.hpp"
#include "benchmarks/study/study_verb.hpp"
#include "benchmarks/terminal/status_line.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/run/exact_survey.hpp"
#include "postprocess/report/orders.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// Repetitions go round the curves, level by level.
/// @param cases  of each curve
std::vector<CampaignRun> plan_of(const StudyRequest& request,
                                 const std::vector<const cases::Case*>& cases,
                                 const std::vector<WorkCurve>& curves) {
  const StudyOptions& study = request.run;
  const std::filesystem::path folder = std::filesystem::path(study.directory) / "runs";
  std::vector<CampaignRun> plan;
  for (const int level : study.levels) {
    for (int repetition = 1; repetition <= request.repeats; ++repetition) {
      for (size_t curve = 0; curve < curves.size(); ++curve) {
        const cases::Case& setup = *cases[curve];
        const std::string name = curves[curve].name(), method = curves[curve].method;
        RunOptions options;
        options.method = method;
        options.level = level;
        options.threads = study.threads;
        options.directory = (folder / fmt::format("{}_{}_level_{}_{}", input_hash(setup, {}),
                                                  method, level, repetition))
                                .string();
        options.fields = false;
        options.quiet = study.quiet;
        plan.push_back({&setup, options, name, method,
                        fmt::format("{} level {}, repetition {} of {}", name, level, repetition,
                                    request.repeats),
                        repetition});
      }
    }
  }
  return plan;
}

void add_to_curve(const io::RunSummary& run, const cases::Case& setup, WorkCurve& curve) {
  if (curve.points.empty() || curve.points.back().run.level != run.level) {
    if (!curve.points.empty()) require_refined(setup, curve.points.back().run, run);
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

void add_breakdown(const io::RunSummary& run, const std::string& variant, StudyRuns& runs) {
  runs.breakdowns.push_back(breakdown_of(run));
  std::string& message = runs.breakdowns.back().message;
  if (!variant.empty()) message = variant + ": " + message;
}

}  // namespace

StudyRuns runs_of_study(const StudyRequest& request,
                        const std::vector<Variant>& variants,
                        const std::vector<cases::Case>& cases,
                        OutputFolder& output) {
  StudyRuns runs;
  std::vector<const cases::Case*> of_curves;
  for (size_t i = 0; i < variants.size(); ++i) {
    for (const std::string& method : request.run.methods) {
      if (!variants[i].method.empty() && variants[i].method != method) continue;
      runs.curves.push_back({variants[i].label, method, {}});
      of_curves.push_back(&cases[i]);
    }
  }
  std::vector<CampaignRun> plan = plan_of(request, of_curves, runs.curves);
  // of an exact solution the first run tells whether what was asked makes sense: nothing is
  // written before
  const bool is_asked_first = run::ExactSurvey::is_for(cases.front());
  if (is_asked_first) {
    plan.front().options.directory.clear();
  } else {
    output.prepare();
  }
  const size_t n_of_level = runs.curves.size() * static_cast<size_t>(request.repeats);
  size_t n_taken_over = 0;
  const auto add = [&](size_t number, const CampaignResult& made, const Schedule&) {
    if (interrupt_requested()) return;
    const io::RunSummary& run = made.run.summary;
    if (number == 0 && is_asked_first) {
      runs.field = field_of(request, run);
      output.prepare();
    }
    n_taken_over += made.taken_over ? 1 : 0;
    WorkCurve& curve = runs.curves[number % runs.curves.size()];
    if (run.status == "step limit") {
      if (plan[number].repetition == 1) runs.cut_short.emplace_back(run).variant = curve.variant;
    } else if (run.status != "breakdown") {
      add_to_curve(run, *plan[number].setup, curve);
      if ((run.status == "unsound" || !run.unmet.empty()) && plan[number].repetition == 1)
        runs.unsound.push_back(run);
    } else if (plan[number].repetition == 1) {
      add_breakdown(run, curve.variant, runs);
    }
    if ((number + 1) % n_of_level != 0) return;
    StatusLine(request.run.quiet)
        .keep(fmt::format("level {} done: {} runs, {} of them taken over", run.level, n_of_level,
                          n_taken_over));
    n_taken_over = 0;
  };
  make_runs(plan, request.run.resume ? TakeOver::timed : TakeOver::nothing, add);
  runs.curves.erase(std::remove_if(runs.curves.begin(), runs.curves.end(),
                                   [](const WorkCurve& curve) { return curve.points.empty(); }),
                    runs.curves.end());
  return runs;
}

}  // namespace diptych::harness
