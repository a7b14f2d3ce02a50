#pragma once
/// The verb `verify`: tables in turn, what is asked beside what is measured, and the page of all.

#include "benchmarks/verifier/verification.hpp"

namespace diptych::harness {

struct VerifyRequest {
  std::vector<std::string> names;  ///< of tables; empty: all that are shipped in the set
  VerificationSet set = VerificationSet::verification;
  VerificationOptions run;
  std::string page;    ///< file; empty: in the folder of the runs
  bool check = false;  ///< a bound that is not met is an error
};

/// @return exit code
/// @throws base::InputError for a table before the first is run; base::BoundError with `check`
int verify_tables(const VerifyRequest& request);

}  // namespace diptych::harness
