#pragma once
/// [[reference]] of the case file: values of probes from elsewhere, for the report.
/// Test: tests/common/cases/references_test.cpp

#include "common/cases/case.hpp"
#include "common/cases/values.hpp"

#include <filesystem>
#include <vector>

namespace diptych::cases {

/// @param folder  of the case file: where reference.file is looked for
/// @throws base::InputError on a probe that the case does not have, a malformed file
std::vector<ReferenceCase> read_references(const std::vector<SectionValues>& entries,
                                           const std::vector<ProbeCase>& probes,
                                           const std::filesystem::path& folder);

}  // namespace diptych::cases
