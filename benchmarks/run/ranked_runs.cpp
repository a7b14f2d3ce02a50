#include "benchmarks/run/ranked_runs.hpp"

#include "benchmarks/run/memory.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/rank_programs.hpp"
#include "benchmarks/run/surveys.hpp"
#include "common/base/error.hpp"
#include "common/parallel/agreement.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/parallel/ranks.hpp"
#include "common/parallel/sharing.hpp"
#include "common/run/ranks/leading_solver.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <new>
#include <optional>

namespace diptych::harness {

namespace {

using parallel::Communicator;

/// What a scene is made of; to end where there is no text.
struct Request {
  std::string text, file, partition;
  std::vector<std::string> overrides;
  std::int64_t threads = 0;
};

void share(Communicator& ranks, Request& request) {
  ranks.meet();
  for (std::string* text : {&request.text, &request.file, &request.partition})
    parallel::share(ranks, *text);
  std::int64_t n = std::ssize(request.overrides);
  parallel::share(ranks, n);
  request.overrides.resize(static_cast<size_t>(n));
  for (std::string& override : request.overrides)
    parallel::share(ranks, override);
  parallel::share(ranks, request.threads);
}

/// At the end of its lifetime all ranks meet: others wait long for what rank 0 does alone, and it
/// needs the processors.
struct Meeting {
  explicit Meeting(Communicator& of) : ranks(of) {}
  ~Meeting() { ranks.meet(); }
  Meeting(const Meeting&) = delete;
  Meeting& operator=(const Meeting&) = delete;
  Communicator& ranks;
};

constexpr const char* set_up = "set-up";  ///< what all ranks do or wait for

/// Null where the run has one rank.
const run::LeadingSolver* leading_of(const Scene& scene) {
  return dynamic_cast<const run::LeadingSolver*>(scene.solver.get());
}

/// Follows the run of a scene that rank 0 makes.
void follow_run(Communicator& ranks, const Request& request) {
  reset_peak_rss();
  std::optional<cases::Case> setup;
  {
    const parallel::Phase phase(set_up);
    parallel::agree_on(ranks, [&] {
      const Meeting after(ranks);
      parallel::set_threads(static_cast<int>(request.threads));  // limits are this machine's
      setup = cases::case_from_text(request.text, request.file, request.overrides, menus());
    });
    (void)programs_of_all(ranks);
  }
  run::follow(*setup, ranks, request.partition, [&](const run::Solver& solver) {
    return surveys_among(ranks, *setup, nullptr, nullptr, solver);
  });
}

}  // namespace

std::unique_ptr<Scene> scene_of_run(const cases::Case& setup,
                                    const RunOptions& options,
                                    const PartMade& made) {
  const auto make = [&] {
    return std::make_unique<Scene>(setup, options.method, options.level, GraphPairs::released,
                                   made);
  };
  Communicator* ranks = parallel::all_ranks();
  if (ranks == nullptr) {
    std::unique_ptr<Scene> scene = make();
    scene->solver->take(surveys_of(setup, scene->mesh.mesh, scene->graph, *scene->solver));
    return scene;
  }
  Request request{setup.text, setup.file, options.partition, setup.overrides, options.threads};
  share(*ranks, request);
  std::unique_ptr<Scene> scene;
  {
    const parallel::Phase phase(set_up);
    parallel::agree_on(*ranks, [&] {
      const Meeting after(*ranks);
      scene = make();
    });
    if (const auto notice = notice_of_processors(programs_of_all(*ranks)))
      scene->notices.push_back(*notice);
  }
  scene->solver = std::make_unique<run::LeadingSolver>(
      std::move(scene->solver), scene->graph, *ranks, options.partition,
      [&](const run::Solver& solver) {
        return surveys_among(*ranks, setup, &scene->mesh.mesh, &scene->graph, solver);
      });
  return scene;
}

void note_memory(const Scene& scene, io::RunSummary& summary) {
  const auto* leading = leading_of(scene);
  if (leading == nullptr) return;
  const run::RankMemory largest = leading->memory();
  summary.building_rss_bytes = std::max(summary.building_rss_bytes, largest.peak);
  summary.running_rss_bytes = std::max(summary.running_rss_bytes, largest.settled);
}

void note_ranks(const Scene& scene, io::RunSummary& summary) {
  const auto* leading = leading_of(scene);
  if (leading == nullptr) return;
  const run::RankCosts costs = leading->costs();
  summary.ranks = parallel::all_ranks()->size();
  summary.imbalance = costs.imbalance;
  summary.exchanged_bytes = costs.parcel_bytes;
  summary.peak_rss_bytes = std::max(summary.peak_rss_bytes, leading->memory().peak);
  summary.communication_seconds = costs.communication_seconds;
}

bool is_following() {
  return parallel::all_ranks() != nullptr && parallel::all_ranks()->rank() != 0;
}

int follow_runs() {
  Communicator& ranks = *parallel::all_ranks();
  for (;;) {
    Request request;
    share(ranks, request);
    if (request.text.empty()) return 0;
    try {
      follow_run(ranks, request);
    } catch (const base::Error&) {
      // rank 0 has met it too, or has been told of it: it says so
    } catch (const std::bad_alloc&) {
      // the same, while the scene was made
    } catch (const std::exception& error) {
      std::fputs(
          fmt::format("diptych: rank {} of {}: {}\n", ranks.rank(), ranks.size(), error.what())
              .c_str(),
          stderr);
      ranks.abort(static_cast<int>(base::ExitCode::environment));
    }
  }
}

LedRuns::~LedRuns() {
  if (parallel::all_ranks() == nullptr) return;
  Request end;
  share(*parallel::all_ranks(), end);
}

}  // namespace diptych::harness
