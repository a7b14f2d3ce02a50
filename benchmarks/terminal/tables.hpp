#pragma once
/// Results as text for a terminal: at most 100 columns, aligned, units in the headings, plain
/// ASCII. What is missing is "-". Test: tests/report/tables_test.cpp

#include "common/io/run_record.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/study_report.hpp"

#include <map>
#include <string>
#include <vector>

namespace diptych::harness {

using report::observed_order;

/// Both methods beside each other with the ratio SPH / FVM: size, steps, cost, relative L2 errors
/// of each field, energy residual.
/// @param difference field: relative L2 difference of the two runs at the nodes
std::string comparison_table(const io::RunSummary& sph,
                             const io::RunSummary& fvm,
                             const std::map<std::string, double>& difference,
                             const std::map<std::string, double>& history_difference = {});

/// The methods and their variants as columns, five beside each other: size, cost, relative L2
/// errors, probes, energy residual, and how far each variant is from each method.
/// @param runs  of one level, a run for each column
std::string columns_table(const std::vector<io::RunSummary>& runs,
                          const std::vector<report::ColumnDistance>& distances);

/// One row per level, coarse to fine: relative L2 errors and the order observed between a level and
/// the one before it, by spacing. A block for each method, and for each four fields.
std::string convergence_table(const std::vector<io::RunSummary>& levels);

}  // namespace diptych::harness
