/// diptych study: error against cost, or quantities, of a case and its variants; stability limits;
/// local steps; or an atlas.

#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/study/atlas.hpp"
#include "benchmarks/study/study_verb.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/time/integrator.hpp"

#include <memory>

namespace diptych::verbs {

namespace {

struct StudyArguments : CaseArguments {
  harness::StudyRequest request;
  static constexpr int by_default = harness::StudyRequest::by_default;
  int n_levels = by_default;
  bool stability = false, local_steps = false, fresh = false, atlas = false, coarse = false;
  std::string before;  ///< of an atlas

  /// With the variants of --with; those of the case file too, where nothing else varies.
  harness::StudyOptions compared_options() const;
};

harness::StudyOptions StudyArguments::compared_options() const {
  CaseArguments arguments = *this;
  arguments.no_variants = no_variants || stability || local_steps || !request.variations.empty();
  return arguments.comparison_options(arguments.read());
}

/// An atlas says itself what varies and what is judged.
void check_atlas(const StudyArguments& arguments) {
  const harness::StudyRequest& request = arguments.request;
  const bool has_others = arguments.stability || arguments.local_steps ||
                          !request.variations.empty() || !request.quantities.empty() ||
                          !request.field.empty() || !request.integrators.empty() ||
                          request.repeats != harness::StudyRequest::by_default ||
                          !arguments.with.empty() || arguments.no_variants;
  if (arguments.atlas && has_others) {
    throw base::InputError(
        "--atlas goes with --set, --level, --method, --coarse, --before, --fresh and --out: its "
        "file says what varies");
  }
  if (!arguments.atlas && (arguments.coarse || !arguments.before.empty()))
    throw base::InputError("--coarse and --before go with --atlas");
}

int atlas(const StudyArguments& arguments) {
  harness::AtlasRequest request;
  request.atlas = arguments.case_name;
  request.cases_folder = arguments.cases_folder;
  request.overrides = arguments.overrides;
  request.methods = arguments.methods();
  request.level = arguments.levels(1, 1).front();
  request.threads = arguments.threads;
  request.directory = arguments.directory;
  request.before = arguments.before;
  request.coarse = arguments.coarse;
  request.fresh = arguments.fresh;
  request.quiet = arguments.quiet;
  request.force = arguments.force;
  return harness::exit_code_of_study(harness::go_on_from(harness::make_atlas(request)));
}

int study(const StudyArguments& arguments) {
  if (arguments.stability && arguments.local_steps)
    throw base::InputError("--stability and --local-steps are commands of their own: give one");
  const bool has_one_level = arguments.atlas || arguments.stability || arguments.local_steps;
  if (has_one_level && arguments.n_levels != arguments.by_default) {
    throw base::InputError(
        "--levels has no effect with --atlas, --stability and --local-steps, which are of one "
        "level; "
        "--level chooses it");
  }
  check_atlas(arguments);
  if (arguments.atlas) return atlas(arguments);
  harness::StudyRequest request = arguments.request;
  request.case_file = arguments.file();
  request.overrides = arguments.overrides;
  request.run = arguments.compared_options();
  request.run.resume = !arguments.fresh;
  if (arguments.stability) {
    harness::study_stability(request);
    return harness::exit_code_of_study(
        "the limits above are in stability.csv; the same command begins again");
  }
  if (arguments.local_steps) {
    harness::study_local_steps(request);
    return 0;
  }
  request.run.levels =
      arguments.levels(arguments.n_levels == arguments.by_default ? 3 : arguments.n_levels, 1);
  const harness::StudyRuns runs = harness::study_variants(request);
  const int code = harness::exit_code_of_study(runs.breakdowns, runs.unsound,
                                               harness::go_on_from(request.run.directory));
  return harness::code_with_cut_short(code, runs.cut_short);
}

}  // namespace

Action declare_study(CommandLine& line) {
  const auto arguments = std::make_shared<StudyArguments>();
  harness::StudyRequest& request = arguments->request;
  arguments->declare_with_method(line);
  arguments->declare_force(line);
  arguments->declare_variants(line);
  line.repeated("--vary", request.variations,
                "KEY=VALUE,VALUE: a run for every value, all combinations; repeatable");
  line.option("--levels", arguments->n_levels, "number of levels, from --level on (default 3)");
  line.option("--repeats", request.repeats,
              "timings of every run (default 3; without an exact solution 1)");
  line.flag("--fresh", arguments->fresh, "run finished runs again too");
  line.option("--field", request.field, "whose error is shown, such as stress");
  line.repeated("--quantity", request.quantities,
                "what is shown of each variant: a probe ('tip'), a part of it ('tip, greatest'), "
                "'kinetic energy', 'least J', 'seconds', ..., or 'all'; repeatable");
  line.flag("--stability", arguments->stability, "find the largest stable time step by bisection");
  line.list(
      "--integrators", request.integrators,
      ("with --stability: " + base::joined(time::integrator_menu().names(), ",") + " (default all)")
          .c_str());
  line.option("--steps", request.stability.n_steps, "with --stability: of a trial (default 1000)");
  line.only_with("--integrators", "--stability");
  line.only_with("--steps", "--stability");
  line.flag("--local-steps", arguments->local_steps,
            "what steps of powers of two, each node's by its own bound, would save");
  line.flag("--atlas", arguments->atlas,
            "a map of what is stable, stopped or wrong: in place of the case the path of an atlas, "
            "or a name of benchmarks/atlas");
  line.flag("--coarse", arguments->coarse, "with --atlas: few values of each axis");
  line.option("--before", arguments->before,
              "with --atlas: the atlas.json of an earlier program, to compare with");
  return [arguments] { return study(*arguments); };
}

}  // namespace diptych::verbs
