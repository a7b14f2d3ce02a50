/// What stands above the tables on the pages of the repository.

#include "benchmarks/probes/machine_probes.hpp"
#include "benchmarks/verifier/verification.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

constexpr const char* of_verification =
    "Errors are relative L2 norms at the end of the run, of velocity v, displacement u = x - X, F "
    "- "
    "I, first Piola-Kirchhoff\nstress P, and A = C_v^-1 - I, unless a table says otherwise. Orders "
    "are between a row and the one above. Times are\nthose of one machine on one day.";

constexpr const char* of_literature =
    "Extrapolated values, orders and error bars come from the three finest levels (Richardson; the "
    "grid convergence index,\nGCI, is the bar over the finest value; where values oscillate or "
    "diverge no order stands and the bar is three times\ntheir range). \"agree\": whether |SPH - "
    "FVM| on the finest level is within the sum of both bars. Energies are those at\nthe end. "
    "Flop are counted as 147 a pair update (benchmarks/probes/work_counts.hpp).";

/// As a block of code in Markdown.
std::string indented(const std::string& text) {
  std::string block;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    block += "    " + text.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return block;
}

}  // namespace

VerificationPage page_heading(VerificationSet set, bool quick) {
  if (set == VerificationSet::verification) {
    return {"Verification", "benchmarks/verify", "benchmarks/verification", of_verification, quick};
  }
  const int threads = parallel::n_threads();
  return {"Cases of the literature", "benchmarks/verify --literature", "benchmarks/literature",
          fmt::format(
              "Cases without an exact solution, both methods, {} thread{}. A pair update is one "
              "directed pair in one stage. What the\nmachine could do, measured after the "
              "runs:\n\n{}\n{}",
              threads, threads == 1 ? "" : "s",
              indented(probes::probes_text(probes::measure_machine(threads))), of_literature),
          quick};
}

}  // namespace diptych::harness
