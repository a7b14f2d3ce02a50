#pragma once
/// [[reference]] of the case file: values of probes from elsewhere, for the report.
/// Test: tests/common/run/case_references_test.cpp

#include "common/run/case.hpp"
#include "common/run/case_values.hpp"

#include <filesystem>
#include <vector>

namespace diptych::run {

/// @param folder  of the case file: where reference.file is looked for
/// @throws base::InputError on a probe that the case does not have, a malformed file
std::vector<ReferenceCase> read_references(const std::vector<SectionValues>& entries,
                                           const std::vector<ProbeCase>& probes,
                                           const std::filesystem::path& folder);

}  // namespace diptych::run
