#pragma once
/// The [[probe]] entries of a case file.

#include "common/run/case.hpp"
#include "common/run/case_values.hpp"

namespace diptych::run {

/// @param vocabulary  of the case; quantities may use the fields of ProbeFields besides
/// @throws base::InputError
std::vector<ProbeCase> read_probes(const std::vector<SectionValues>& entries,
                                   const Vocabulary& vocabulary);

}  // namespace diptych::run
