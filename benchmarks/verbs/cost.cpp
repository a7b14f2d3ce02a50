/// diptych cost: what each option of the scheme costs per stage, or cost by size.

#include "benchmarks/cost/cost_verb.hpp"
#include "benchmarks/run/interruption.hpp"
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
    harness::report_option_costs(arguments.folder, arguments.quiet);
  } else {
    harness::report_size_costs(
        {arguments.sizes, arguments.threads, arguments.overrides, arguments.quiet},
        arguments.folder);
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
