/// diptych cost: what each option of the scheme costs per stage, or cost by size.

#include "benchmarks/cost/option_costs.hpp"
#include "benchmarks/cost/size_costs.hpp"
#include "benchmarks/probes/machine_probes.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/parallel/thread_count.hpp"

#include <memory>

namespace diptych::verbs {

namespace {

struct CostArguments {
  std::vector<int> sizes;
  std::vector<std::string> overrides;
  std::string folder = "results";
  int threads = 1;
  bool quiet = false;
};

int report_costs(const CostArguments& arguments) {
  if (arguments.sizes.empty()) {
    const auto table = harness::measure_option_costs(20, 12, arguments.quiet);
    print(harness::cost_text(table));
    write_output(arguments.folder, "option_costs.csv", harness::cost_csv(table));
  } else {
    const auto rows = harness::measure_size_costs(
        {arguments.sizes, arguments.threads, arguments.overrides, arguments.quiet});
    if (!rows.empty()) {
      print(probes::probes_text(probes::measure_machine(arguments.threads)) + "\n");
      print(harness::size_text(rows));
      write_output(arguments.folder, "size_costs.csv", harness::size_csv(rows));
    }
  }
  return harness::exit_code_of_study("the rows above are written; the same command begins again");
}

}  // namespace

Action declare_cost(CommandLine& line) {
  const auto arguments = std::make_shared<CostArguments>();
  line.list("--sizes", arguments->sizes,
            "nodes along the side of a cube, such as 22,47,101: cost, set-up and memory by size "
            "instead");
  line.count("--threads", arguments->threads, 0, parallel::most_threads, "with --sizes: default 1");
  line.repeated("--set", arguments->overrides, "with --sizes: key=value of a case; repeatable");
  line.option("--out", arguments->folder, "output folder (default results)");
  line.flag("--quiet", arguments->quiet, "no progress");
  line.only_with("--threads", "--sizes");
  line.only_with("--set", "--sizes");
  return [arguments] { return report_costs(*arguments); };
}

}  // namespace diptych::verbs
