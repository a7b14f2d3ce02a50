#pragma once
/// What a single run prints.

#include "common/io/run_record.hpp"

#include <string>

namespace diptych::harness {

/// A few lines: size, cost, errors, energy.
std::string run_table(const io::RunSummary& summary);

}  // namespace diptych::harness
