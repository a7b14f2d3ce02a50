/// The runs of an atlas.

#include "benchmarks/study/atlas.hpp"

#include "benchmarks/campaign/campaign.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/output_folder.hpp"
#include "benchmarks/run/provenance.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/terminal/output.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "benchmarks/terminal/status_line.hpp"
#include "benchmarks/terminal/text.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/copy.hpp"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

/// The case of a point. @throws base::InputError that names the point
cases::Case case_of(const Atlas& atlas,
                    const AtlasPoint& point,
                    const std::vector<std::string>& overrides) {
  std::string file = atlas.case_file;
  std::vector<std::string> set = cases::merged_overrides(atlas.set, overrides);
  for (size_t axis = 0; axis < atlas.axes.size(); ++axis) {
    const AtlasChoice& choice = atlas.axes[axis].choices[point.choices[axis]];
    if (!choice.case_file.empty()) file = choice.case_file;
    set.insert(set.end(), choice.set.begin(), choice.set.end());
  }
  try {
    return harness::read_case(file, set);
  } catch (const base::InputError& error) {
    throw base::InputError(fmt::format("{}: {} {}: {}", atlas.file, point.method,
                                       base::joined(settings_of(atlas, point)), error.what()));
  }
}

/// Points that are to be run, with their cases.
struct AtlasPlan {
  std::vector<AtlasPoint> points;
  std::deque<cases::Case> cases;  ///< of each
  std::vector<CampaignRun> runs;  ///< of each
};

AtlasPlan plan_of(const Atlas& atlas, const AtlasRequest& request, const std::string& directory) {
  AtlasPlan plan;
  for (const std::string& method : request.methods) {
    if (!contains(atlas.methods, method)) continue;
    for (const AtlasPoint& point : points_of(atlas, method, request.coarse))
      plan.points.push_back(point);
  }
  for (const AtlasPoint& point : plan.points) {
    const cases::Case& setup = plan.cases.emplace_back(case_of(atlas, point, request.overrides));
    require_memory(setup, {point.method}, {request.level});
    RunOptions options;
    options.method = point.method;
    options.level = request.level;
    options.threads = request.threads;
    options.directory =
        (fs::path(directory) / "runs" /
         fmt::format("{}_{}_level_{}", input_hash(setup, {}), point.method, request.level))
            .string();
    options.fields = false;
    options.quiet = true;  // the atlas tells how far it is, not each of its many runs
    CampaignRun run{&setup, options, point.method, point.method};
    run.may_be_refused = true;
    plan.runs.push_back(run);
  }
  if (plan.points.empty()) throw base::InputError(atlas.file + ": no point is left for --method");
  return plan;
}

void tell(const AtlasRequest& request,
          const AtlasPlan& plan,
          const Atlas& atlas,
          size_t number,
          const Schedule& schedule,
          StatusLine& status) {
  const AtlasPoint& point = plan.points[number];
  const auto left = schedule.seconds_left();
  const std::string text = fmt::format("{} of {}: {} {}{}", number + 1, plan.points.size(),
                                       point.method, base::joined(settings_of(atlas, point)),
                                       left && number + 1 < plan.points.size()
                                           ? fmt::format("; about {} left", duration_text(*left))
                                           : "");
  if (!request.quiet) status.show(text);
}

std::vector<cases::BoundCase> bounds_of(const Atlas& atlas, const cases::Case& setup) {
  std::vector<cases::BoundCase> bounds = atlas.holds;
  bounds.insert(bounds.end(), setup.expect.holds.begin(), setup.expect.holds.end());
  return bounds;
}

/// All files that the runs of the folder may be of.
std::vector<std::string> files_of(const AtlasPlan& plan) {
  std::set<std::string> files;
  for (const cases::Case& setup : plan.cases)
    files.insert(setup.file);
  return {files.begin(), files.end()};
}

/// A map of nothing says that the atlas is at fault, not the schemes.
void check_any_judged(const AtlasMap& map) {
  bool any_judged = map.points.empty(), any_begun = false;
  for (const AtlasPoint& point : map.points) {
    const Outcome outcome = point.judgement.outcome;
    any_begun |= outcome != Outcome::refused;
    any_judged |= outcome != Outcome::refused && outcome != Outcome::unfinished;
  }
  if (any_judged) return;
  throw base::InputError(fmt::format("{}: no point {}: {}", map.atlas.file,
                                     any_begun ? "came to its end" : "could be begun",
                                     map.points.front().judgement.reason));
}

}  // namespace

std::string make_atlas(const AtlasRequest& request) {
  AtlasMap map;
  map.atlas = read_atlas(find_atlas(request.atlas), request.cases_folder);
  const Atlas& atlas = map.atlas;
  const std::string directory =
      request.directory.empty() ? (fs::path("results") / atlas.name).string() : request.directory;
  const bool has_before = !request.before.empty();
  const std::string before = has_before ? io::read_file(request.before) : "";
  AtlasPlan plan = plan_of(atlas, request, directory);
  if (has_before) {  // what is wrong with it is told of before the runs
    AtlasMap planned;
    planned.atlas = atlas;
    planned.points = plan.points;
    if (set_before(planned, before, request.before) == 0)
      throw base::InputError(request.before + ": has no point of the atlas " + atlas.name);
  }
  OutputFolder output(directory, plan.cases.front(), OutputKind::atlas, request.force,
                      files_of(plan));
  output.prepare();
  map.n_planned = plan.points.size();
  size_t n_taken_over = 0;
  StatusLine status(request.quiet);
  const auto add = [&](size_t number, CampaignResult made, const Schedule& schedule) {
    if (made.run.summary.status == "interrupted") return;
    AtlasPoint point = plan.points[number];
    point.judgement =
        judged(made.run.summary, made.run.history, bounds_of(atlas, plan.cases[number]));
    if (!made.run.history.empty()) {
      point.kinetic_growth = run_figures(made.run.summary, made.run.history).at("kinetic growth");
    }
    point.run = std::move(made.run.summary);
    map.seconds += point.run.wall_seconds;
    n_taken_over += made.taken_over ? 1 : 0;
    map.points.push_back(std::move(point));
    tell(request, plan, atlas, number, schedule, status);
  };
  make_runs(plan.runs, request.fresh ? TakeOver::nothing : TakeOver::ended, add);
  status.keep(fmt::format("{} of {} points, {} of them taken over", map.points.size(),
                          map.n_planned, n_taken_over));
  const io::Provenance p = provenance("");
  map.program = p.program;
  map.commit = p.commit;
  map.date = p.date;
  if (has_before) set_before(map, before, request.before);
  print(atlas_text(map));
  write_output(directory, "atlas.csv", atlas_csv(map));
  write_output(directory, "atlas.json", atlas_json(map));
  write_output(directory, "atlas.html", atlas_html(map));
  check_any_judged(map);
  return directory;
}

}  // namespace diptych::harness
