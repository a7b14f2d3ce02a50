/// diptych check: reads a case, builds its graphs and makes one step; or reads what runs have left.

#include "benchmarks/run/case_check.hpp"
#include "benchmarks/run/judgement.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/record_check.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/io/folder_lock.hpp"
#include "common/parallel/for_chunks.hpp"

#include <fmt/format.h>
#include <memory>

namespace diptych::verbs {

namespace {

int check(const CaseArguments& arguments) {
  const cases::Case setup = arguments.read();
  harness::check_figures(setup);
  parallel::set_threads(arguments.threads);
  for (const std::string& method : arguments.methods()) {
    const auto check = harness::check_case(setup, method, arguments.level);
    const auto kilobytes = [&](std::int64_t bytes) {
      return 1e-3 * static_cast<double>(bytes) / static_cast<double>(check.nodes);
    };
    print(base::folded(
        fmt::format(
            "{:4} {} nodes, {} cells, {} pairs ({:.1f} a node, least {})\n"
            "     linear exactness {:.1e}, closure {:.1e}, first dt {:.4g} s, about {} steps\n"
            "     memory a node: {:.2f} kB in arrays of the solver, {:.2f} kB of the process while "
            "running,\n     {:.2f} kB while building\n"
            "     in all: {} of memory at most (estimated beforehand: {}),\n"
            "     {} for the steps of the whole run with {} {}, as the first ones went,\n"
            "     after {} of set-up\n",
            method, check.nodes, check.cells, check.pairs, check.quality.mean_neighbours,
            check.quality.least_neighbours, check.quality.linear_exactness, check.quality.closure,
            check.dt, check.steps, kilobytes(check.bytes), kilobytes(check.running_bytes),
            kilobytes(check.building_bytes),
            harness::bytes_text(static_cast<double>(check.building_bytes)),
            harness::bytes_text(check.estimated_bytes), harness::duration_text(check.seconds),
            parallel::n_threads(), parallel::n_threads() == 1 ? "thread" : "threads",
            harness::duration_text(check.setup_seconds)),
        5));
    if (!check.operators.empty()) print(base::folded("     " + check.operators + "\n", 5));
    for (const std::string& notice : check.notices)
      print(base::folded("     note: " + notice + "\n", 5));
  }
  print(setup.name + ": the case is sound\n");
  return 0;
}

/// Of runs: what is there, what is wrong with it.
int check_records(const std::string& directory, const std::vector<std::string>& runs) {
  size_t n_faults = 0;
  for (const std::string& run : runs) {
    const harness::RecordCheck check = harness::check_record(run);
    print(fmt::format("{}: {}, {} steps, {} rows, {} frames, {} checkpoints{}\n", run,
                      check.status.empty() ? "no summary" : check.status, check.steps, check.rows,
                      check.frames, check.checkpoints, check.is_whole() ? ": whole" : ""));
    for (const std::string& note : check.notes)
      print("  " + note + "\n");
    for (const std::string& fault : check.faults)
      print("  " + fault + "\n");
    n_faults += check.faults.size();
  }
  if (const auto holder = io::lock_holder(directory))
    print(fmt::format("{}: {} writes there\n", directory, *holder));
  if (n_faults == 0) return 0;
  throw base::InputError(fmt::format("{}: {} of what runs have left {} not whole, named above",
                                     directory, n_faults, n_faults == 1 ? "is" : "are"));
}

int check_case_or_records(const CaseArguments& arguments) {
  const std::string& name = arguments.case_name;
  const std::vector<std::string> runs = harness::records_in(name);
  return runs.empty() ? check(arguments) : check_records(name, runs);
}

}  // namespace

Action declare_check(CommandLine& line) {
  const auto arguments = std::make_shared<CaseArguments>();
  arguments->declare_with_method(line);
  return [arguments] { return check_case_or_records(*arguments); };
}

}  // namespace diptych::verbs
