#pragma once
/// What a single run prints.

#include "benchmarks/terminal/reference_table.hpp"
#include "common/io/run_record.hpp"

#include <string>

namespace diptych::harness {

/// A few lines: size, cost, errors, energy. @param times  see uncertainty_verdict
std::string run_table(const io::RunSummary& summary, const ReferenceTimes& times = {});

/// Two lines where cells of the mesh have turned inside out, which no node's J shows; else nothing.
/// A warning and no breakdown: deformed cells are part of neither method's state, both go on
/// soundly by their own lights, and the instants before are good.
std::string inverted_cells_warning(const io::RunSummary& summary);

}  // namespace diptych::harness
