#pragma once
/// Where a result comes from: version, commit, compiler, processor; and what the process used.

#include "common/io/run_record.hpp"

namespace diptych::harness {

io::Provenance provenance(const std::string& case_hash);

/// Hash of the program that is running: two runs with the same one come from the same code.
const std::string& program_hash();

}  // namespace diptych::harness
