#pragma once
/// The [[probe]] entries of a case file.

#include "common/cases/case.hpp"
#include "common/cases/values.hpp"

namespace diptych::cases {

/// @param vocabulary  of the case; quantities may use the fields of ProbeFields besides
/// @throws base::InputError
std::vector<ProbeCase> read_probes(const std::vector<SectionValues>& entries,
                                   const functions::Vocabulary& vocabulary);

}  // namespace diptych::cases
