#pragma once
/// Orders of convergence, and the runs of a study in the order that tables and charts need.
/// Test: tests/report/orders_test.cpp

#include "common/io/run_record.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace diptych::report {

/// log(e_coarse / e_fine) / log(h_coarse / h_fine); NaN where no order can be formed: an error or a
/// spacing that is not positive and finite, or equal spacings.
double observed_order(double coarse_error,
                      double fine_error,
                      double coarse_spacing,
                      double fine_spacing);

/// The orders that a run is said to converge with in v and u, as spacing and step fall together:
/// from that of its integrator (3 of SSP-RK3 and SSP-RK43, else 2) to that of its operators (3
/// where they sum by parts with the pair (4, 2), else 2), or that of the operators alone where it
/// is the lower one.
struct FormalOrder {
  double least = 2, greatest = 2;
};
FormalOrder formal_order(const io::RunSummary& run);

/// Methods at the settings of the case in the order of a reader: sph, fvm, then others by name. A
/// verdict is on these.
std::vector<std::string> methods_of(const std::vector<io::RunSummary>& runs);

/// These, then the columns of variants as they come (RunSummary::column).
std::vector<std::string> columns_of(const std::vector<io::RunSummary>& runs);

/// Runs of one column from coarse to fine.
std::vector<io::RunSummary> runs_of(const std::vector<io::RunSummary>& runs,
                                    std::string_view column);

/// "sph" of the column "sph-compact", and "compact", which is empty where it is of no variant.
std::string method_of_column(const std::string& column);
std::string variant_of_column(const std::string& column);

/// Fields with errors: velocity, displacement, deformation_gradient, stress, cofactor, jacobian,
/// viscous_C, viscous_G, then others by name.
std::vector<std::string> fields_of(const std::vector<io::RunSummary>& runs);

/// The relative L2 error, NaN where it was not measured.
double error_of(const io::RunSummary& run, const std::string& field);

/// "SPH", "Finite volume", or the name itself.
std::string method_title(const std::string& method);

/// "SPH compact" for "sph-compact"; of a method its title.
std::string column_title(const std::string& column);

/// "v", "u", "F", "P", "H", "J", "A", "S", or nothing for a field without a symbol.
std::string field_symbol(const std::string& field);

/// "deformation gradient" for "deformation_gradient".
std::string field_title(const std::string& field);

}  // namespace diptych::report
