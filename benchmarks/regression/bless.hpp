#pragma once
/// New baselines: at what size a case is recorded, and the record.

#include "benchmarks/regression/regress.hpp"
#include "benchmarks/regression/verb.hpp"
#include "benchmarks/run/case_list.hpp"

#include <string>

namespace diptych::harness {

/// The size at which a case is blessed: that of the request, else what was recorded, else the case
/// as it stands on levels 0 and 1 where that is a matter of seconds.
/// @param recorded  without methods where there is no baseline yet
/// @throws base::InputError for a first baseline without a size of a case that takes longer
RegressBaseline blessed_size(const RegressRequest& request,
                             const ListedCase& entry,
                             RegressBaseline recorded);

/// The baseline that a measurement makes.
RegressBaseline record_of(RegressBaseline size,
                          const RegressMeasurement& now,
                          const std::string& why);

/// Prints what changes and writes the new baseline.
/// @throws base::BreakdownError where a run broke down, base::InputError where a figure is not
///         finite: nothing is recorded
RegressBaseline recorded(const RegressRequest& request,
                         const RegressBaseline& old,
                         const RegressBaseline& size,
                         const RegressMeasurement& now);

}  // namespace diptych::harness
