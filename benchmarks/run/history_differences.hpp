#pragma once
/// How far the histories of two runs of one case are apart.

#include "common/io/run_record.hpp"

#include <map>
#include <string>
#include <vector>

namespace diptych::harness {

/// Root mean square over the output times of the difference of each probe, relative to its largest
/// magnitude in both runs; 0 where both are zero throughout. Of the times that both have.
/// @param names  of the probes, in their order
std::map<std::string, double> history_differences(const std::vector<std::string>& names,
                                                  const std::vector<io::HistoryRow>& a,
                                                  const std::vector<io::HistoryRow>& b);

}  // namespace diptych::harness
