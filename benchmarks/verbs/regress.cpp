/// diptych regress: cases at a small size against their baselines.

#include "benchmarks/regression/verb.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"

#include <memory>

namespace diptych::verbs {

Action declare_regress(CommandLine& line) {
  const auto request = std::make_shared<harness::RegressRequest>();
  request->directory = "results/regress";
  line.words("case", request->cases, "names or paths of cases (default: all of the folder)");
  line.option("--cases", request->cases_folder, cases_help);
  line.option("--baselines", request->baselines_folder,
              "folder of the baselines, CASE.json each, in place of those of the shipped cases");
  line.option("--junit", request->junit, "also write JUnit XML to this file");
  line.option("--json", request->json, "also write all checks as JSON to this file");
  line.option("--bless", request->bless,
              "record a new baseline of this case, or of all; asks for --why");
  line.option("--why", request->why, "reason of the new baseline, kept with it");
  line.repeated("--set", request->set,
                "with --bless: key=value of the size that is recorded, in place of what was; "
                "repeatable");
  line.option("--levels", request->levels, "with --bless: 1 or 2 (default as recorded, or 2)");
  line.option("--one-level-because", request->one_level_because,
              "with --levels 1: the reason, kept with the baseline");
  line.option("--out", request->directory, "output folder (default results/regress)");
  declare_threads(line, request->threads);
  line.flag("--quiet", request->quiet, "no progress");
  return [request] {
    harness::regress(*request);
    return harness::exit_code_of_study("the same command begins again, nothing is recorded");
  };
}

}  // namespace diptych::verbs
