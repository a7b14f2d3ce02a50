#include "benchmarks/verifier/verify_verb.hpp"

#include "common/base/error.hpp"
#include "common/io/run_record.hpp"

#include <cstdio>
#include <filesystem>

namespace diptych::harness {

int verify_tables(const VerifyRequest& request) {
  std::vector<std::string> names = request.names;
  if (names.empty()) names = shipped_verification_tables(request.set);
  std::vector<VerificationTable> tables;
  for (const std::string& name : names)
    tables.push_back(read_verification_table(find_verification_table(name)));
  std::vector<VerificationResult> results;
  bool all_met = true;
  std::vector<PlannedRun> runs;
  for (const auto& table : tables) {
    const auto more = planned_runs(table, request.run);
    runs.insert(runs.end(), more.begin(), more.end());
  }
  Schedule schedule(std::move(runs));
  VerificationOptions options = request.run;
  options.schedule = &schedule;
  for (const auto& table : tables) {
    const auto result = verify(table, options);
    if (!result) {
      std::fputs("diptych: interrupted; the same command goes on from here\n", stderr);
      return static_cast<int>(base::ExitCode::interrupted);
    }
    std::fputs(verification_lines(*result).c_str(), stdout);
    std::fflush(stdout);
    for (const auto& verdict : result->verdicts)
      all_met = all_met && verdict.met;
    results.push_back(*result);
  }
  const bool literature = request.set == VerificationSet::literature;
  const auto page = request.page.empty() ? (std::filesystem::path(request.run.directory) /
                                            (literature ? "LITERATURE.md" : "VERIFICATION.md"))
                                               .string()
                                         : request.page;
  io::write_file_atomically(
      page, verification_page(results, page_heading(request.set, request.run.quick)));
  std::fputs(("\noutput: " + page + "\n").c_str(), stdout);
  if (request.check && !all_met) throw base::BoundError("a bound was not met; see above");
  return 0;
}

}  // namespace diptych::harness
