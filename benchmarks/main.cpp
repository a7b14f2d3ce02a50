/// The command line. Verbs and exit codes are contracts; see README.md.

#include "benchmarks/harness/backends.hpp"
#include "benchmarks/harness/case_list.hpp"
#include "benchmarks/harness/convergence.hpp"
#include "benchmarks/harness/cost_verb.hpp"
#include "benchmarks/harness/history_differences.hpp"
#include "benchmarks/harness/interruption.hpp"
#include "benchmarks/harness/material_report.hpp"
#include "benchmarks/harness/regress.hpp"
#include "benchmarks/harness/run_table.hpp"
#include "benchmarks/harness/spinning.hpp"
#include "benchmarks/harness/study.hpp"
#include "benchmarks/harness/study_verb.hpp"
#include "benchmarks/harness/tables.hpp"
#include "benchmarks/harness/verify_verb.hpp"
#include "common/base/error.hpp"
#include "common/base/registry.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"
#include "common/run/case_keys.hpp"
#include "common/run/case_reader.hpp"

#include <algorithm>
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <new>

namespace {

using namespace diptych;

struct Arguments {
  std::string case_name, method = "both", directory, key;
  std::vector<std::string> overrides;
  std::string path = "shear-oscillation", update = "gauss";
  harness::MaterialPath material;
  int level = 0, levels = 3, threads = 0;
  bool quiet = false, no_fields = false, fresh = false;
  std::vector<std::string> quantities, tables;
  std::vector<int> sizes;
  int size_threads = 1;
  std::string page;
  bool check = false, quick = false, stability = false, literature = false;
  harness::StudyRequest study;
  harness::RegressRequest regress;
};

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

std::vector<std::string> methods_of(const std::string& method) {
  if (method == "both") return harness::method_menu().names();
  harness::method_menu().at(method);
  return {method};
}

run::Case case_of(const Arguments& arguments) {
  return run::read_case(harness::find_case(arguments.case_name), arguments.overrides);
}

std::string directory_of(const Arguments& arguments, const run::Case& setup) {
  if (!arguments.directory.empty()) return arguments.directory;
  return (std::filesystem::path("results") / setup.name).string();
}

harness::StudyOptions study_options(const Arguments& arguments, const run::Case& setup) {
  harness::StudyOptions options;
  options.methods = methods_of(arguments.method);
  options.levels = {arguments.level};
  options.threads = arguments.threads;
  options.directory = directory_of(arguments, setup);
  options.fields = !arguments.no_fields;
  options.quiet = arguments.quiet;
  return options;
}

void write_report(const run::Case& setup,
                  const harness::Study& study,
                  const std::string& dir,
                  const std::vector<harness::MethodConvergence>& convergence = {}) {
  const std::string path = (std::filesystem::path(dir) / "report.html").string();
  report::write_report(path, harness::report_of(setup, study, convergence));
  print(fmt::format("\nreport: {}\n", path));
}

int run_verb(const Arguments& arguments) {
  const run::Case setup = case_of(arguments);
  const auto options = study_options(arguments, setup);
  const harness::Study study = harness::run_study(setup, options);
  for (const auto& summary : study.runs)
    print(harness::run_table(summary) + "\n");
  print(fmt::format("output: {}\n", options.directory));
  return harness::exit_code_of_study(harness::begin_again(options.directory));
}

int compare_verb(Arguments arguments) {
  arguments.method = "both";
  const run::Case setup = case_of(arguments);
  auto options = study_options(arguments, setup);
  options.shapes = true;
  const harness::Study study = harness::run_study(setup, options);
  if (study.runs.size() == 2) {
    std::vector<std::string> probes;
    for (const auto& probe : setup.probes)
      probes.push_back(probe.name);
    const auto apart = harness::history_differences(
        probes, study.histories.at(study.runs[0].method), study.histories.at(study.runs[1].method));
    print(harness::comparison_table(study.runs[0], study.runs[1], study.differences, apart));
    for (const auto& summary : study.runs)
      print(harness::inverted_cells_warning(summary));
    write_report(setup, study, options.directory);
  }
  return harness::exit_code_of_study(harness::begin_again(options.directory));
}

/// What is written and printed of the levels that are finished.
void show_convergence(const run::Case& setup,
                      const Arguments& arguments,
                      const harness::Study& study,
                      const std::string& directory) {
  std::vector<harness::LevelRecord> records;
  for (size_t i = 0; i < study.runs.size(); ++i) {
    if (study.runs[i].status == "interrupted") continue;
    const std::string file = (std::filesystem::path(study.directories[i]) / "history.csv").string();
    records.push_back({study.runs[i], io::history_columns_from_csv(io::read_file(file), file)});
  }
  const auto convergence = harness::convergence_of(records, arguments.quantities);
  for (const auto& method : convergence) {
    print(harness::convergence_table(method.levels) + "\n");
    const std::string table = harness::quantity_table(method);
    if (!table.empty()) print(table + "\n");
  }
  const std::string agreement = harness::agreement_table(convergence);
  if (!agreement.empty()) print(agreement + "\n");
  for (const auto& summary : study.runs)
    print(harness::inverted_cells_warning(summary));
  if (convergence.empty()) return;
  const auto write = [&](const char* name, const std::string& text) {
    const std::string file = (std::filesystem::path(directory) / name).string();
    io::write_file_atomically(file, text);
    print(fmt::format("output: {}\n", file));
  };
  write("convergence.csv", harness::convergence_csv(convergence));
  write("convergence.tex", harness::convergence_tex(convergence));
  if (study.shapes.size() < methods_of(arguments.method).size() &&
      !harness::interrupt_requested()) {
    print(
        "bodies and difference of the methods: not all in this report, as a run of the finest "
        "level "
        "was\n  taken over; 'diptych compare' or --fresh gives them\n");
  }
  write_report(setup, study, directory, convergence);
}

int converge_verb(const Arguments& arguments) {
  if (arguments.levels < 2) throw base::InputError("--levels must be 2 or more");
  const run::Case setup = case_of(arguments);
  auto options = study_options(arguments, setup);
  options.fields = false;
  options.shapes = true;
  options.resume = !arguments.fresh;
  options.levels.clear();
  for (int k = 0; k < arguments.levels; ++k)
    options.levels.push_back(arguments.level + k);
  const harness::Study study = harness::run_study(setup, options);
  for (const std::string& directory : study.taken_over)
    print(fmt::format("taken over, not run again: {}\n", directory));
  if (!study.taken_over.empty()) print("\n");
  show_convergence(setup, arguments, study, options.directory);
  return harness::exit_code_of_study(harness::go_on_from(options.directory));
}

int verify_verb(const Arguments& arguments) {
  harness::VerifyRequest request;
  request.names = arguments.tables;
  request.set = arguments.literature ? harness::VerificationSet::literature
                                     : harness::VerificationSet::verification;
  const std::string folder = arguments.literature ? "literature" : "verification";
  request.run.directory = arguments.directory.empty() ? "results/" + folder : arguments.directory;
  request.run.threads = arguments.threads;
  request.run.fresh = arguments.fresh;
  request.run.quick = arguments.quick;
  request.run.quiet = arguments.quiet;
  request.page = arguments.page;
  request.check = arguments.check;
  return harness::verify_tables(request);
}

int regress_verb(const Arguments& arguments) {
  harness::RegressRequest request = arguments.regress;
  request.directory = arguments.directory.empty() ? "results/regress" : arguments.directory;
  request.threads = arguments.threads;
  request.quiet = arguments.quiet;
  harness::regress(request);
  return harness::exit_code_of_study("the same command begins again, nothing is recorded");
}

int study_verb(const Arguments& arguments) {
  harness::StudyRequest request = arguments.study;
  request.case_file = harness::find_case(arguments.case_name);
  request.overrides = arguments.overrides;
  request.methods = methods_of(arguments.method);
  request.level = arguments.level;
  request.threads = arguments.threads;
  request.quiet = arguments.quiet;
  request.directory = directory_of(arguments, run::read_case(request.case_file));
  request.fresh = arguments.fresh;
  if (arguments.stability)
    harness::study_stability(request);
  else
    harness::study_work_precision(request);
  return harness::exit_code_of_study(
      arguments.stability ? "the limits above are in stability.csv; the same command begins again"
                          : harness::go_on_from(request.directory));
}

int cost_verb(const Arguments& arguments) {
  const std::string folder = arguments.directory.empty() ? "results" : arguments.directory;
  if (arguments.sizes.empty()) {
    harness::report_option_costs(folder, arguments.quiet);
  } else {
    harness::report_size_costs(
        {arguments.sizes, arguments.size_threads, arguments.overrides, arguments.quiet}, folder);
  }
  return harness::exit_code_of_study("the rows above are written; the same command begins again");
}

int check_verb(const Arguments& arguments) {
  const run::Case setup = case_of(arguments);
  for (const std::string& method : methods_of(arguments.method)) {
    const auto check = harness::check_case(setup, method, arguments.level);
    const auto kilobytes = [&](std::int64_t bytes) {
      return 1e-3 * static_cast<double>(bytes) / static_cast<double>(check.nodes);
    };
    print(fmt::format(
        "{:4} {} nodes, {} cells, {} pairs ({:.1f} a node, least {}), linear exactness {:.1e}, "
        "closure {:.1e}\n     first dt {:.4g} s, about {} steps\n"
        "     memory a node: {:.2f} kB in arrays of the solver; process {:.2f} kB while running, "
        "{:.2f} kB while building\n",
        method, check.nodes, check.cells, check.pairs, check.quality.mean_neighbours,
        check.quality.least_neighbours, check.quality.linear_exactness, check.quality.closure,
        check.dt, check.steps, kilobytes(check.bytes), kilobytes(check.running_bytes),
        kilobytes(check.building_bytes)));
  }
  print(setup.name + ": the case is sound\n");
  return 0;
}

int material_verb(const Arguments& arguments) {
  const run::Case setup = case_of(arguments);
  harness::MaterialPath path = arguments.material;
  harness::read_path_name(arguments.path, path);
  path.update = base::Registry<harness::Update>("--update")
                    .add("linear", harness::Update::linear)
                    .add("gauss", harness::Update::gauss)
                    .at(arguments.update);
  const auto material = run::make_material_point(setup.material);
  const auto points = harness::follow(*material, path);
  print(harness::path_table(setup, path, points,
                            harness::scan_hyperbolicity(*material, points, 200)));
  const std::string folder = directory_of(arguments, setup);
  io::make_directory(folder);
  const auto write = [&](const std::string& ending, const std::string& text) {
    const std::string file =
        (std::filesystem::path(folder) / ("material-" + arguments.path + ending)).string();
    io::write_file_atomically(file, text);
    print("output: " + file + "\n");
  };
  write(".csv", harness::path_csv(points));
  write(".svg", harness::path_svg(setup, path, points));
  return 0;
}

int list_verb() {
  for (const auto& [name, title] : harness::shipped_cases()) {
    print(fmt::format("{:<32} {}\n", name, title));
  }
  return 0;
}

int explain_verb(const Arguments& arguments) {
  print(arguments.key == "all" ? run::reference_page() : run::explain(arguments.key));
  return 0;
}

void add_case_options(CLI::App* verb, Arguments& arguments, bool with_method) {
  verb->add_option("case", arguments.case_name, "path of a case file, or a name of 'list'")
      ->required();
  if (with_method) verb->add_option("--method", arguments.method, "sph, fvm or both");
  verb->add_option("--level", arguments.level, "the mesh spacing is divided by 2^level");
  verb->add_option("--threads", arguments.threads, "0: all processors");
  verb->add_option("--set", arguments.overrides, "key=value, overrides the case file; repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->add_option("--out", arguments.directory, "output folder (default results/CASE)");
  verb->add_flag("--quiet", arguments.quiet, "no progress");
  verb->add_flag("--no-fields", arguments.no_fields, "write no field frames");
}

void add_study_options(CLI::App* verb, Arguments& arguments) {
  add_case_options(verb, arguments, true);
  verb->add_option("--vary", arguments.study.variations,
                   "KEY=VALUE,VALUE: a run for every value, all combinations; repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->add_option("--levels", arguments.study.n_levels, "number of levels, from --level on");
  verb->add_option("--repeats", arguments.study.repeats, "timings of every run (default 3)");
  verb->add_flag("--fresh", arguments.fresh, "run finished runs again too");
  verb->add_option("--field", arguments.study.field, "whose error is shown, such as stress");
  verb->add_flag("--stability", arguments.stability,
                 "find the largest stable time step by bisection");
  verb->add_option("--integrators", arguments.study.integrators,
                   "with --stability: leapfrog,ssp-rk2,ssp-rk3,ssp-rk43 (default all)")
      ->delimiter(',');
  verb->add_option("--steps", arguments.study.stability.n_steps,
                   "with --stability: of a trial (default 1000)");
}

void add_regress_options(CLI::App* verb, Arguments& arguments) {
  verb->add_option("case", arguments.regress.cases, "names of 'list' (default: all)");
  verb->add_option("--bless", arguments.regress.bless,
                   "record a new baseline of this case, or of all; asks for --why");
  verb->add_option("--why", arguments.regress.why, "reason of the new baseline, kept with it");
  verb->add_option("--out", arguments.directory, "output folder (default results/regress)");
  verb->add_option("--threads", arguments.threads, "0: all processors");
  verb->add_flag("--quiet", arguments.quiet, "no progress");
}

void add_material_options(CLI::App* verb, Arguments& arguments) {
  harness::MaterialPath& path = arguments.material;
  verb->add_option("case", arguments.case_name, "path of a case file, or a name of 'list'")
      ->required();
  verb->add_option("--path", arguments.path,
                   "{shear, confined, uniaxial, creep}-{step, ramp, oscillation}: F12, F11, F11 "
                   "with free sides, or P11 with free sides");
  verb->add_option("--amplitude", path.amplitude,
                   "strain, or Pa for creep, of step or oscillation");
  verb->add_option("--rate", path.rate, "of a ramp, per second");
  verb->add_option("--frequency", path.angular_frequency, "of an oscillation, rad/s");
  verb->add_option("--end", path.end, "final time, s")->required();
  verb->add_option("--steps", path.n_steps, "number of steps (default 1000)");
  verb->add_option("--update", arguments.update, "of the branches: gauss (default) or linear");
  verb->add_option("--set", arguments.overrides, "key=value, overrides the case file; repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->add_option("--out", arguments.directory, "output folder (default results/CASE)");
}

int dispatch(int argc, char** argv) {
  CLI::App app{"Diptych: one large-strain solid-dynamics scene on SPH and finite volumes"};
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("diptych ") + DIPTYCH_VERSION);
  Arguments arguments;
  auto* run = app.add_subcommand("run", "run a case with one method or both");
  add_case_options(run, arguments, true);
  auto* compare =
      app.add_subcommand("compare", "run both methods, print and report the difference");
  add_case_options(compare, arguments, false);
  auto* converge = app.add_subcommand("converge", "run levels, print errors and observed orders");
  add_case_options(converge, arguments, true);
  converge->add_option("--levels", arguments.levels, "number of levels, from --level on");
  converge->add_flag("--fresh", arguments.fresh, "run finished levels again too");
  converge
      ->add_option("--quantity", arguments.quantities,
                   "column of history.csv to extrapolate, or 'all'; repeatable (default: energies, "
                   "least J, probes)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  auto* verify = app.add_subcommand("verify", "run the verification tables, say which bounds hold");
  verify->add_option("table", arguments.tables,
                     "names or files of tables (default: all of benchmarks/verification)");
  verify->add_option("--out", arguments.directory,
                     "folder of the runs (default results/verification)");
  verify->add_option("--page", arguments.page, "the page to write (default OUT/VERIFICATION.md)");
  verify->add_flag("--literature", arguments.literature,
                   "the cases of benchmarks/literature, on a page LITERATURE.md of their own");
  verify->add_option("--threads", arguments.threads, "0: all processors");
  verify->add_flag("--check", arguments.check, "exit code 5 where a bound is not met");
  verify->add_flag("--fresh", arguments.fresh, "run finished runs again too");
  verify->add_flag("--quick", arguments.quick, "without the finest level of each sequence");
  verify->add_flag("--quiet", arguments.quiet, "no progress");
  auto* regress = app.add_subcommand(
      "regress", "all cases at a small size against their baselines; code 5 where a bound fails");
  add_regress_options(regress, arguments);
  auto* study = app.add_subcommand(
      "study", "error against cost of a case and its variants, or stability limits");
  add_study_options(study, arguments);
  auto* check = app.add_subcommand("check", "read a case, build its graphs and make one step");
  add_case_options(check, arguments, true);
  auto* material = app.add_subcommand(
      "material", "strain the case's material alone: stresses, loops, loss of hyperbolicity");
  add_material_options(material, arguments);
  auto* cost = app.add_subcommand("cost", "what each option of the scheme costs per stage");
  auto* sizes = cost->add_option("--sizes", arguments.sizes,
                                 "nodes along the side of a cube, such as 22,47,101: cost, set-up "
                                 "and memory by size instead")
                    ->delimiter(',');
  cost->add_option("--threads", arguments.size_threads, "with --sizes: default 1")->needs(sizes);
  cost->add_option("--set", arguments.overrides, "with --sizes: key=value of a case; repeatable")
      ->needs(sizes);
  cost->add_option("--out", arguments.directory, "output folder (default results)");
  cost->add_flag("--quiet", arguments.quiet, "no progress");
  auto* list = app.add_subcommand("list", "shipped cases");
  auto* explain = app.add_subcommand("explain", "what a key of a case file means");
  explain->add_option("key", arguments.key, "such as mesh.cells; 'all' prints the reference page")
      ->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    throw base::InputError(std::string(error.what()) + "; see diptych --help");
  }
  if (run->parsed()) return run_verb(arguments);
  if (compare->parsed()) return compare_verb(arguments);
  if (converge->parsed()) return converge_verb(arguments);
  if (verify->parsed()) return verify_verb(arguments);
  if (regress->parsed()) return regress_verb(arguments);
  if (study->parsed()) return study_verb(arguments);
  if (check->parsed()) return check_verb(arguments);
  if (material->parsed()) return material_verb(arguments);
  if (cost->parsed()) return cost_verb(arguments);
  if (list->parsed()) return list_verb();
  if (explain->parsed()) return explain_verb(arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  harness::limit_spinning(argv);
  harness::catch_interrupts();
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return dispatch(argc, argv);
  } catch (const base::Error& error) {
    std::fputs(fmt::format("diptych: {}\n", error.what()).c_str(), stderr);
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    std::fputs("diptych: out of memory; use a smaller --level\n", stderr);
    return static_cast<int>(base::ExitCode::environment);
  }
}
