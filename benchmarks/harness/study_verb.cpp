#include "benchmarks/harness/study_verb.hpp"

#include "benchmarks/harness/backends.hpp"
#include "benchmarks/harness/case_mesh.hpp"
#include "benchmarks/harness/run_case.hpp"
#include "benchmarks/harness/status_line.hpp"
#include "benchmarks/harness/variants.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/time/integrator.hpp"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void write(const StudyRequest& request, const std::string& name, const std::string& text) {
  const std::string file = (std::filesystem::path(request.directory) / name).string();
  io::write_file_atomically(file, text);
  print("output: " + file + "\n");
}

/// Limits of one variant with one method, integrator by integrator.
void add_limits(const StudyRequest& request,
                const run::Case& setup,
                const std::string& label,
                const std::string& method,
                StatusLine& status,
                std::vector<StabilityLimit>& limits) {
  const CaseMesh mesh =
      mesh_of(setup, request.level, std::filesystem::temp_directory_path().string());
  const scheme::PairGraph graph = method_menu().at(method)(mesh.mesh, setup);
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

}  // namespace

void study_stability(const StudyRequest& asked) {
  StudyRequest request = asked;
  if (request.integrators.empty()) request.integrators = time::integrator_menu().names();
  for (const std::string& integrator : request.integrators)
    time::integrator_menu().at(integrator);
  if (request.stability.n_steps < 40) throw base::InputError("--steps must be 40 or more");
  const auto variants = variants_of(request.variations);
  std::vector<run::Case> cases;  // all are read before the first runs
  for (const Variant& variant : variants)
    cases.push_back(case_of_variant(request.case_file, request.overrides, variant));
  io::make_directory(request.directory);
  parallel::set_threads(request.threads);
  std::vector<StabilityLimit> limits;
  StatusLine status(request.quiet);
  for (size_t i = 0; i < variants.size(); ++i) {
    for (const std::string& method : request.methods) {
      if (interrupt_requested()) break;
      add_limits(request, cases[i], variants[i].label, method, status, limits);
    }
  }
  print(fmt::format("{}, level {}: largest stable time step, as a factor on the graph bound\n",
                    cases.front().name, request.level));
  print(stability_table(limits));
  write(request, "stability.csv", stability_csv(limits));
}

}  // namespace diptych::harness
