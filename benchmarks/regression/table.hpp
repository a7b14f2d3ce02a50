#pragma once
/// What the regression shows: a line a case and method, below it every failure; and the difference
/// of two baselines.

#include "benchmarks/regression/regress.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

struct RegressRow {
  std::string case_name, method;  ///< sph, fvm, or both
  std::vector<RegressCheck> checks;
  double seconds = 0;  ///< of the runs behind them
};

/// For 100 columns; with a line of totals at the end.
std::string regress_table(const std::vector<RegressRow>& rows);

bool has_failed(const std::vector<RegressRow>& rows);

/// What the program ends with: of all that failed the kind that says most about the rest, in the
/// order environment, wrong input, breakdown, bound; done where nothing failed.
base::ExitCode exit_code_of(const std::vector<RegressRow>& rows);

/// "1 breakdown, 2 checks failed"
std::string failures_in_words(const std::vector<RegressRow>& rows);

/// Who recorded what when, and figures old -> new where they differ, the largest changes first.
std::string difference_text(const RegressBaseline& old, const RegressBaseline& now);

}  // namespace diptych::harness
