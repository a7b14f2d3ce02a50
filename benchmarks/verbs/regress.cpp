/// diptych regress: all cases at a small size against their baselines.

#include "benchmarks/harness/regress.hpp"

#include "benchmarks/harness/interruption.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"

#include <memory>

namespace diptych::verbs {

Action declare_regress(CommandLine& line) {
  const auto request = std::make_shared<harness::RegressRequest>();
  request->directory = "results/regress";
  line.words("case", request->cases, "names of 'list' (default: all)");
  line.option("--bless", request->bless,
              "record a new baseline of this case, or of all; asks for --why");
  line.option("--why", request->why, "reason of the new baseline, kept with it");
  line.option("--out", request->directory, "output folder (default results/regress)");
  declare_threads(line, request->threads);
  line.flag("--quiet", request->quiet, "no progress");
  return [request] {
    harness::regress(*request);
    return harness::exit_code_of_study("the same command begins again, nothing is recorded");
  };
}

}  // namespace diptych::verbs
