#pragma once
/// Bounds that are known not to be met: a list that may only shrink. A line for each,
/// "TABLE | RUN | COLUMN | ASKED | METHOD"; what stands behind "#" is a comment.
/// Test: tests/harness/known_misses_test.cpp

#include "benchmarks/verifier/verification.hpp"

#include <set>
#include <string>
#include <vector>

namespace diptych::harness {

/// The bounds that these results do not meet, as such lines.
std::set<std::string> misses_of(const std::vector<VerificationResult>& results);

/// @throws base::InputError where a line does not have five parts, or stands twice, with its place;
///         base::EnvironmentError where the file cannot be read
std::set<std::string> read_known_misses(const std::string& path);

/// What differs from the list, a sentence each; empty where all misses are known and all that are
/// known are misses. Lines of tables that were not made are left out.
std::vector<std::string> differences_from_known(const std::vector<VerificationResult>& results,
                                                const std::set<std::string>& known);

}  // namespace diptych::harness
