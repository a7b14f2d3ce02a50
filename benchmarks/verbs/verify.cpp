/// diptych verify: the verification tables, what is asked beside what is measured.

#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "benchmarks/verifier/verify_verb.hpp"

#include <memory>

namespace diptych::verbs {

namespace {

struct VerifyArguments {
  harness::VerifyRequest request;
  std::string directory;
  bool literature = false;
};

int verify(const VerifyArguments& arguments) {
  harness::VerifyRequest request = arguments.request;
  request.set = arguments.literature ? harness::VerificationSet::literature
                                     : harness::VerificationSet::verification;
  const std::string folder = arguments.literature ? "literature" : "verification";
  request.run.directory = arguments.directory.empty() ? "results/" + folder : arguments.directory;
  return harness::verify_tables(request);
}

}  // namespace

Action declare_verify(CommandLine& line) {
  const auto arguments = std::make_shared<VerifyArguments>();
  harness::VerifyRequest& request = arguments->request;
  line.words("table", request.names,
             "names or files of tables (default: all of benchmarks/verification)");
  line.option("--out", arguments->directory, "folder of the runs (default results/verification)");
  line.option("--page", request.page, "the page to write (default OUT/VERIFICATION.md)");
  line.flag("--literature", arguments->literature,
            "the cases of benchmarks/literature, on a page LITERATURE.md of their own");
  declare_threads(line, request.run.threads);
  line.flag("--check", request.check, "exit code 5 where a bound is not met");
  line.flag("--fresh", request.run.fresh, "run finished runs again too");
  line.flag("--quick", request.run.quick, "without the finest level of each sequence");
  line.flag("--quiet", request.run.quiet, "no progress");
  return [arguments] { return verify(*arguments); };
}

}  // namespace diptych::verbs
