/// diptych verify: the verification tables, what is asked beside what is measured, and the page of
/// all.

#include "benchmarks/run/interruption.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "benchmarks/verifier/known_misses.hpp"
#include "benchmarks/verifier/verification.hpp"
#include "common/base/error.hpp"
#include "common/io/run_record.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace diptych::verbs {

namespace {

using harness::VerificationSet;

struct VerifyArguments {
  std::vector<std::string> names;  ///< of tables; empty: all that are shipped in the set
  harness::VerificationOptions run;
  std::string page, known;
  bool literature = false, check = false;
};

int verify(const VerifyArguments& arguments) {
  const auto set =
      arguments.literature ? VerificationSet::literature : VerificationSet::verification;
  harness::VerificationOptions options = arguments.run;
  if (options.directory.empty())
    options.directory = arguments.literature ? "results/literature" : "results/verification";
  std::vector<harness::VerificationTable> tables;
  for (const std::string& name :
       arguments.names.empty() ? harness::shipped_verification_tables(set) : arguments.names)
    tables.push_back(harness::read_verification_table(harness::find_verification_table(name)));
  bool all_met = true;
  const auto results = harness::verify(tables, options, [&](const auto& result) {
    print(harness::verification_lines(result));
    all_met = all_met && std::all_of(result.verdicts.begin(), result.verdicts.end(),
                                     [](const auto& verdict) { return verdict.met; });
  });
  if (!results) return harness::exit_code_of_study("the same command goes on from here");
  std::string page = arguments.page;
  if (page.empty()) {
    page = (std::filesystem::path(options.directory) /
            (arguments.literature ? "LITERATURE.md" : "VERIFICATION.md"))
               .string();
  }
  io::write_file_atomically(page, harness::verification_page(*results, set, options.quick));
  print("\noutput: " + page + "\n");
  if (!arguments.known.empty()) {
    const auto differences =
        harness::differences_from_known(*results, harness::read_known_misses(arguments.known));
    for (const std::string& difference : differences)
      print(difference + "\n");
    if (!differences.empty()) {
      throw base::BoundError(fmt::format("{}: {} not as this list says; see above", arguments.known,
                                         differences.size() == 1 ? "a bound is" : "bounds are"));
    }
    return 0;
  }
  if (arguments.check && !all_met) throw base::BoundError("a bound was not met; see above");
  return 0;
}

}  // namespace

Action declare_verify(CommandLine& line) {
  const auto arguments = std::make_shared<VerifyArguments>();
  harness::VerificationOptions& run = arguments->run;
  line.words("table", arguments->names,
             "names or files of tables (default: all of benchmarks/verification)");
  line.option("--out", run.directory, "folder of the runs (default results/verification)");
  line.option("--page", arguments->page, "the page to write (default OUT/VERIFICATION.md)");
  line.flag("--literature", arguments->literature,
            "the cases of benchmarks/literature, on a page LITERATURE.md of their own");
  declare_threads(line, run.threads);
  line.flag("--check", arguments->check, "exit code 5 where a bound is not met");
  line.option("--known", arguments->known,
              "with --check: the bounds that may be unmet, a list; code 5 where another one is, or "
              "one of these is met");
  line.only_with("--known", "--check");
  line.flag("--fresh", run.fresh, "run finished runs again too");
  line.flag("--quick", run.quick, "without the finest level of each sequence");
  line.flag("--quiet", run.quiet, "no progress");
  return [arguments] { return verify(*arguments); };
}

}  // namespace diptych::verbs
