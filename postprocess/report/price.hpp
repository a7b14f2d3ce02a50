#pragma once
/// What the same error costs by two methods. Between the runs of a method error and seconds follow
/// straight lines in log-log; nothing is extrapolated. Test: tests/report/verdict_test.cpp

#include "common/io/run_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::report {

/// y at x on the polygon through the points in log-log, on the first segment that holds x; NaN
/// where none does.
double log_log_value(const std::vector<double>& xs, const std::vector<double>& ys, double x);

struct Price {
  double error = 0;              ///< relative L2, the smallest that both methods reach
  double first = 0, second = 0;  ///< s of the time loop, by either method
};

/// @param first, second  runs of one method each, coarse to fine
/// @return nothing where a method has fewer than two finished runs with this error, or none is
/// common
std::optional<Price> price_of_error(const std::vector<io::RunSummary>& first,
                                    const std::vector<io::RunSummary>& second,
                                    const std::string& field);

}  // namespace diptych::report
