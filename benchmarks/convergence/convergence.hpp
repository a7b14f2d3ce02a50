#pragma once
/// A study of refinement as numbers that people script against: every quantity on every level,
/// observed orders, extrapolated values, error bars; as text for a terminal, CSV and LaTeX.
/// Test: tests/report/convergence_test.cpp

#include "common/io/run_record.hpp"
#include "postprocess/report/grid_convergence.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

/// A run and what its history.csv holds.
struct LevelRecord {
  io::RunSummary summary;
  std::vector<io::HistoryColumn> history;
};

/// A scalar at the final time, or the norm of an error, on the levels of one column: a method, or a
/// variant of one.
struct Quantity {
  std::string name, unit;
  bool is_error = false;
  std::vector<double> values;  ///< coarse to fine; NaN where a level has none
  double scale = 0;  ///< largest size over the run of the finest level; of kinetic and strain
                     ///< energy and dissipations, that of their sum
};

struct ColumnConvergence {
  std::string column, case_name;       ///< column: see RunSummary
  std::vector<io::RunSummary> levels;  ///< coarse to fine; finished runs only
  std::vector<Quantity> errors;        ///< L1, L2, Linf of each field
  std::vector<Quantity> scalars;       ///< those that are zero on every level are left out
  std::vector<std::string> zero;       ///< their names
};

/// @param columns  of the history
/// @throws base::InputError on a name that none of them has
void check_columns(const std::vector<io::HistoryColumn>& columns,
                   const std::vector<std::string>& wanted);

/// @param wanted  names of columns of the history, without units; empty: energies, least J, and
///                all that the case adds (probes); "all": every column
/// @throws base::InputError on a name that no column has
std::vector<ColumnConvergence> convergence_of(const std::vector<LevelRecord>& records,
                                              const std::vector<std::string>& wanted);

/// What the levels up to `level` (an index) say; nothing below three of them, or for errors.
std::optional<report::GridConvergence> estimate(const ColumnConvergence& study,
                                                const Quantity& quantity,
                                                size_t level);

/// log(e_coarse/e_fine)/log(h_coarse/h_fine) of an error at `level` and the one before.
double order_of_error(const ColumnConvergence& study, const Quantity& quantity, size_t level);

/// Error bar of the value at `level`, from three levels or from the first two; NaN where there is
/// none.
double error_bar(const ColumnConvergence& study, const Quantity& quantity, size_t level);

/// Scalars of one column for a terminal of 100 columns; empty where there are none.
std::string quantity_table(const ColumnConvergence& study);

/// Both methods, at the settings of the case, on the finest level: difference of each scalar
/// against the sum of both error bars, as far as both methods resolve it (report::verdict_on).
/// Empty where there is nothing to compare.
/// @param causes  quantity: why the methods are apart on it ([[apart]] of the case)
std::string agreement_table(const std::vector<ColumnConvergence>& studies,
                            const std::map<std::string, std::string>& causes = {});

/// One line per column ("method": sph, fvm, or sph-compact for a variant), quantity and level, with
/// the order and the estimate of the levels so far.
std::string convergence_csv(const std::vector<ColumnConvergence>& studies);

/// Two plain tabulars per column, of errors and of scalars; needs no package.
std::string convergence_tex(const std::vector<ColumnConvergence>& studies);

}  // namespace diptych::harness
