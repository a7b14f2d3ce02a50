/// Kernel benchmarks (Google Benchmark), one thread unless the name says more. Per kernel: ns per
/// node (and stage), ns per directed pair, percent of the multiply-add peak that its counted flop
/// are, percent of the triad that its streamed geometry is; probes and kernels in the same run.
/// Flop and bytes: benchmarks/probes/work_counts.hpp.

#include "benchmarks/micro/scene.hpp"
#include "benchmarks/probes/machine_probes.hpp"
#include "benchmarks/probes/work_counts.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/physics/materials/mooney_rivlin.hpp"
#include "common/scheme/sweeps/compiled_material.hpp"
#include "common/scheme/sweeps/face_correction.hpp"
#include "common/scheme/sweeps/momentum.hpp"

#include <benchmark/benchmark.h>
#include <cstdio>

namespace diptych::micro {
namespace {

probes::MachineProbes machine;  // measured before the first kernel

using probes::seconds;

/// Runs the kernel and reports.
/// @param work    per directed pair; nothing: not counted
/// @param stages  in one call of the kernel
template <class Kernel>
void measure(benchmark::State& run,
             const scheme::PairGraph& graph,
             const Kernel& kernel,
             const probes::PairWork& work = {},
             double stages = 1,
             int threads = 1) {
  kernel();  // pages and caches
  const double start = seconds(threads);
  for (auto _ : run)
    kernel();
  const double each = (seconds(threads) - start) / (static_cast<double>(run.iterations()) * stages);
  const double nodes = static_cast<double>(graph.n_nodes());
  const double pairs = static_cast<double>(graph.n_pairs());
  const probes::Peak& peak = threads == 1 ? machine.double_one : machine.double_all;
  run.counters["ns/node"] = 1e9 * each / nodes;
  if (work.flop == 0) return;
  run.counters["ns/pair"] = 1e9 * each / pairs;
  run.counters["%fma"] = 100 * work.flop * pairs / (each * peak.flops);
  run.counters["%mem"] = 100 * work.streamed * pairs / (each * peak.bandwidth);
}

/// As made for the face correction: without stress and wave speeds.
void strain_rates(benchmark::State& run, SceneChoice choice) {
  choice.face_correction = true;
  Scene scene(choice);
  const auto sweeps = scheme::face_correction_sweeps<3>();
  measure(
      run, graph_of(choice.graph), [&] { sweeps.gradients(scene.body, 0, scene.body.n_blocks); },
      probes::strain_work(3));
}

void face_correction(benchmark::State& run, const std::string& graph) {
  Scene scene({graph, 0, true});
  const auto sweeps = scheme::face_correction_sweeps<3>();
  measure(
      run, graph_of(graph), [&] { sweeps.stresses(scene.body, 1.0 / 6, 0, scene.body.n_blocks); },
      probes::correction_work(3));
}

/// Results of sweeps, one per chunk.
struct Results {
  explicit Results(const Scene& scene)
      : power(static_cast<size_t>(parallel::n_chunks_of(scene.body.n_blocks))),
        other(power),
        limited(power) {}
  std::vector<double> power, other, limited;
};

void momentum(benchmark::State& run, const SceneChoice& choice, bool with_bound) {
  Scene scene(choice);
  Results results(scene);
  scheme::evaluate_strain_rates<3>({scene.body, *scene.material, scene.frozen, 0, nullptr, 0,
                                    results.power.data(), results.other.data()});
  const auto sweep = scheme::momentum_function<3>({}, true);
  const auto kernel = [&] {
    scheme::sum_forces<3>({scene.body, 1, with_bound, results.power.data(), results.other.data(),
                           results.limited.data()},
                          sweep);
    benchmark::DoNotOptimize(results.power.data());
  };
  measure(run, graph_of(choice.graph), kernel, probes::momentum_work(3));
}

using algebra::Lanes;

/// Stress and wave speeds of all blocks, results into the records of the body.
DIPTYCH_CLONES void stress_and_speeds(Scene& scene,
                                      const scheme::Model<physics::MooneyRivlin>& model) {
  using Record = scheme::NodeRecord<3>;
  scheme::Body<3>& body = scene.body;
  for (std::int64_t b = 0; b < body.n_blocks; ++b) {
    const auto X = scheme::load_deformation(body, b);
    const auto response =
        scheme::response_of_block(model, body, scene.frozen, X, b,
                                  [](int, const physics::BranchState<Lanes>&, const auto&) {});
    const auto P = physics::piola_stress<true>(response, X);
    scheme::put_tensor<3>(body.records, b, Record::P, P);
    const auto speeds = physics::speed_bounds(response, X, model.rho_R, true, false);
    body.records.put(b, Record::z_p, model.rho_R * speeds.c_p);
    body.records.put(b, Record::z_s, model.rho_R * speeds.c_s);
  }
}

void stress(benchmark::State& run, int n_branches) {
  Scene scene({"fvm-hex", n_branches, false});
  using Compiled = scheme::CompiledMaterial<physics::MooneyRivlin>;
  const auto& model = static_cast<const Compiled&>(*scene.material).model();
  measure(run, graph_of("fvm-hex"), [&] { stress_and_speeds(scene, model); });
}

/// New internal variables of the first branch of all blocks.
DIPTYCH_CLONES void relax(scheme::Body<3>& body, const scheme::Relaxation& rule) {
  for (std::int64_t b = 0; b < body.n_blocks; ++b) {
    const auto F = algebra::get_tensor<3>(body.F, b, 0, 1);
    const auto drive = scheme::linear_drive(body, physics::right_tensors(F), b);
    const auto branch = scheme::relaxed_branch<3, true>(body, rule, drive, b, 0);
    algebra::put_A<3>(body.A, b, 0, branch.A);
    algebra::put_S<3>(body.S, b, 0, branch.S);
  }
}

void relaxation(benchmark::State& run, scheme::Relaxation::Rule rule) {
  Scene scene({"fvm-hex", 1, false});
  const scheme::Relaxation update(rule, true, 1e-4, scene.material->branches());
  measure(run, graph_of("fvm-hex"), [&] { relax(scene.body, update); });
}

/// A whole stage: step by step, divided by the evaluations of a step.
void stage(benchmark::State& run,
           const SceneChoice& choice,
           const std::string& integrator,
           int threads) {
  parallel::set_threads(threads);
  const auto solver = run::make_solver(case_of(choice, integrator), graph_of(choice.graph));
  measure(
      run, graph_of(choice.graph), [&] { solver->step(1e6); },
      probes::stage_work(3, choice.face_correction), solver->evaluations_per_step(),
      parallel::n_threads());
  parallel::set_threads(1);
}

template <class... Arguments>
void add(const std::string& name, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond);
}

/// Both sweeps in both arrangements, with geometry that is shared or streamed, by precision.
void add_layouts(const std::vector<std::string>& graphs) {
  using scheme::Arrangement;
  for (const auto& graph : graphs) {
    for (const std::string nodes : {"", " single", " moved", " moved mixed", " moved single"}) {
      for (const auto arrangement : {Arrangement::rows, Arrangement::runs}) {
        const SceneChoice choice{graph + nodes, 0, false, arrangement};
        const std::string name =
            std::string(arrangement == Arrangement::rows ? "rows/" : "runs/") + choice.graph;
        add("layout/strain rates/" + name, strain_rates, choice);
        add("layout/momentum/" + name, momentum, choice, false);
      }
    }
  }
}

void add_all() {
  const std::vector<std::string> graphs{"sph-52", "fvm-tet", "fvm-hex"};
  for (const auto& graph : graphs)
    add("strain rates/" + graph, strain_rates, SceneChoice{graph});
  for (const int n : {0, 1, 3})
    add("stress and speeds/" + std::to_string(n) + " branches", stress, n);
  for (const auto& graph : graphs)
    add("momentum/" + graph, momentum, SceneChoice{graph}, false);
  add("momentum with rate/sph-52", momentum, SceneChoice{"sph-52"}, true);
  add_layouts(graphs);
  add("relaxation/linear", relaxation, scheme::Relaxation::Rule::linear);
  add("relaxation/gauss", relaxation, scheme::Relaxation::Rule::gauss);
  for (const auto& graph : graphs)
    add("face correction/" + graph, face_correction, graph);
  for (const auto& graph : graphs) {
    add("stage/" + graph + " single", stage, SceneChoice{graph + " single"}, "ssp-rk3", 1);
    for (const int n : {0, 1, 3}) {
      add("stage/" + graph + "/" + std::to_string(n) + " branches", stage,
          SceneChoice{graph, n, false}, "ssp-rk3", 1);
    }
    add("stage/" + graph + "/leapfrog", stage, SceneChoice{graph, 0, false}, "leapfrog", 1);
    add("stage/" + graph + "/corrected", stage, SceneChoice{graph, 0, true}, "ssp-rk3", 1);
    add("stage/" + graph + "/all threads", stage, SceneChoice{graph, 0, false}, "ssp-rk3", 0);
  }
}

}  // namespace
}  // namespace diptych::micro

int main(int argc, char** argv) {
  using namespace diptych;
  std::vector<char*> arguments(argv, argv + argc);
  std::string tabular = "--benchmark_counters_tabular=true";
  arguments.insert(arguments.begin() + 1, tabular.data());
  int n = static_cast<int>(arguments.size());
  benchmark::Initialize(&n, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(n, arguments.data())) return 2;
  micro::machine = probes::measure_machine(0);
  std::fputs(probes::probes_text(micro::machine).c_str(), stdout);
  parallel::set_threads(1);
  micro::add_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
