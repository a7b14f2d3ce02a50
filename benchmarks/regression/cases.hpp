#pragma once
/// Which cases a regression takes and where their baselines are.

#include "benchmarks/regression/table.hpp"
#include "benchmarks/regression/verb.hpp"
#include "benchmarks/run/case_list.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// The cases of a request, unread: those that are named, that of --bless, or all of the folder.
/// @throws base::InputError for a request that contradicts itself, a word that is no case, a folder
///         without cases, two cases of one name, cases that are not shipped without --baselines
std::vector<ListedCase> wanted_cases(const RegressRequest& request);

/// Where the baseline of a case is, or would be.
std::string baseline_path(const RegressRequest& request, const std::string& case_name);

/// What was recorded of a case. @throws base::InputError for a file that is none, or of another
/// case
RegressBaseline read_baseline(const std::string& path, const std::string& case_name);

/// A failure for every baseline whose case is gone from the folder of the request.
std::vector<RegressRow> orphans(const RegressRequest& request);

}  // namespace diptych::harness
