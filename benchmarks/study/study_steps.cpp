/// The steps that a case may take, of which no runs are kept: stability limits, local steps.

#include "benchmarks/cost/local_steps.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/scene.hpp"
#include "benchmarks/study/study_verb.hpp"
#include "benchmarks/terminal/output.hpp"
#include "benchmarks/terminal/status_line.hpp"
#include "common/base/error.hpp"
#include "common/io/atomic_file.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/time/integrator.hpp"

#include <fmt/format.h>

namespace diptych::harness {

namespace {

constexpr int most_levels = 8;  // of local steps: 1 to 128 of the smallest

/// Limits of one variant with one method, integrator by integrator.
void add_limits(const StudyRequest& request,
                const cases::Case& setup,
                const std::string& label,
                const std::string& method,
                StatusLine& status,
                std::vector<StabilityLimit>& limits) {
  const scheme::PairGraph graph = graph_of(setup, method, request.run.levels.front()).graph;
  for (const std::string& integrator : request.integrators) {
    const std::string name =
        fmt::format("{}{}{} {}", label, label.empty() ? "" : " ", method, integrator);
    int n_trials = 0;
    status.show(name + ": first trial");
    StabilityLimit limit = stability_limit(
        setup, graph, integrator, request.stability, [&](double cfl, const StabilityTrial& trial) {
          status.show(fmt::format("{}: trial {}, cfl {:.3f} is {}", name, ++n_trials, cfl,
                                  trial.stable ? "stable" : "unstable"));
        });
    if (interrupt_requested()) return;
    limit.variant = label;
    limit.method = method;
    status.keep(limit.limit > 0 ? fmt::format("{}: largest stable cfl {:.3f}", name, limit.limit)
                                : fmt::format("{}: no stable cfl", name));
    limits.push_back(limit);
  }
}

/// What belongs to runs. @param flag  the command that keeps none
void refuse_what_is_of_runs(const StudyRequest& request, const std::string& flag) {
  const auto refuse = [&](bool is_given, const char* other, const char* why) {
    if (is_given)
      throw base::InputError(fmt::format("{} has no effect with {}{}", other, flag, why));
  };
  refuse(!request.run.resume, "--fresh", ", which keeps no runs; remove it");
  refuse(!request.quantities.empty(), "--quantity", ", which shows steps; remove it");
  refuse(!request.field.empty(), "--field", ", which shows steps; remove it");
  refuse(request.repeats != StudyRequest::by_default, "--repeats",
         ", which times nothing; remove it");
  refuse(!request.run.variants.empty(), "--with", "; --vary gives the steps of variants");
}

/// Calls use(case, label of the variant, method) for all of them, on the first level.
/// @param title  of the table, after the name of the case and the level
/// @param table  of what came of it, with the file of its lines
template <class Use, class Table, class Lines>
void study_steps(const StudyRequest& request,
                 OutputKind kind,
                 const char* title,
                 const std::string& file,
                 const Use& use,
                 const Table& table,
                 const Lines& lines) {
  const auto variants = variants_of(request.variations);
  const auto cases = cases_of_study(request, variants);
  OutputFolder output(request.run.directory, cases.front(), kind, request.run.force);
  parallel::set_threads(request.run.threads);
  for (size_t i = 0; i < variants.size(); ++i) {
    for (const std::string& method : request.run.methods) {
      if (interrupt_requested()) break;
      use(cases[i], variants[i].label, method);
    }
  }
  print(fmt::format("{}, level {}: {}\n", cases.front().name, request.run.levels.front(), title));
  print(table());
  output.prepare();
  write_output(request.run.directory, file, lines());
}

}  // namespace

void study_stability(const StudyRequest& asked) {
  StudyRequest request = asked;
  refuse_what_is_of_runs(request, "--stability");
  if (request.integrators.empty()) request.integrators = time::integrator_menu().names();
  for (const std::string& integrator : request.integrators)
    time::integrator_menu().at(integrator);
  if (request.stability.n_steps < 40) throw base::InputError("--steps must be 40 or more");
  std::vector<StabilityLimit> limits;
  StatusLine status(request.run.quiet);
  study_steps(
      request, OutputKind::stability, "largest stable time step, as a factor on the graph bound",
      "stability.csv",
      [&](const cases::Case& setup, const std::string& label, const std::string& method) {
        add_limits(request, setup, label, method, status, limits);
      },
      [&] { return stability_table(limits); }, [&] { return stability_csv(limits); });
}

void study_local_steps(const StudyRequest& request) {
  refuse_what_is_of_runs(request, "--local-steps");
  if (!request.integrators.empty())
    throw base::InputError("--integrators has no effect with --local-steps; remove it");
  if (request.stability.n_steps != StabilityOptions{}.n_steps)
    throw base::InputError("--steps has no effect with --local-steps; remove it");
  std::vector<LocalSteps> rows;
  study_steps(
      request, OutputKind::local_steps,
      "nodes by the step that they may take, in smallest steps, and the ideal speed-up\n"
      "of steps of their own",
      "local_steps.csv",
      [&](const cases::Case& setup, const std::string& label, const std::string& method) {
        const auto graph = graph_of(setup, method, request.run.levels.front()).graph;
        rows.push_back(local_steps(graph, most_levels));
        rows.back().variant = label;
        rows.back().method = method;
      },
      [&] { return local_steps_table(rows); }, [&] { return local_steps_csv(rows); });
}

}  // namespace diptych::harness
