#pragma once
/// What each option of the scheme costs per stage, relative to the barest scene: neo-Hookean
/// material, F as the only strain unknown, dissipation of plain jumps, no budget, no output. Each
/// option is added to the scene that its row names; all scenes take turns in several rounds, and
/// the least processor time of each counts, so that ratios hold on a busy machine.

#include <string>
#include <vector>

namespace diptych::harness {

/// One scene of the table.
struct CostRow {
  std::string option;      ///< "energy budget"
  std::string against;     ///< option of the row that its ratio is taken to; empty: the barest
  std::vector<double> ns;  ///< per node and stage, for every column
};

/// Columns "SPH 3-D", "FVM 3-D", "SPH 2-D", "FVM 2-D".
struct CostTable {
  std::vector<std::string> columns;
  std::vector<CostRow> rows;  ///< the barest first
};

/// @param cells   along a side in 3-D; the square of the plane scenes has about as many nodes
/// @param rounds  of all scenes; the least time counts
CostTable measure_option_costs(int cells, int rounds, bool quiet);

std::string cost_text(const CostTable& table);
std::string cost_csv(const CostTable& table);

}  // namespace diptych::harness
