#pragma once
/// The columns of a comparison: both methods at the settings of the case, and beside them variants
/// of either, each with its own case and folder. Test: tests/command_line/variants_test.cpp

#include "common/cases/case.hpp"
#include "common/io/run_record.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

struct Column {
  std::string method;
  std::string variant;           ///< its name; empty: the method at the settings of the case
  std::vector<std::string> set;  ///< of the variant, "key=value"
  cases::Case setup;             ///< with them

  /// "sph", "sph-compact": see RunSummary::column.
  std::string name() const { return io::column_name(method, variant); }
};

/// Which variants stand beside the methods.
struct VariantRequest {
  std::vector<std::string> with;  ///< texts of --with
  bool of_file = true;            ///< those of the case file too
};

/// A column for every method at the settings of the case.
std::vector<Column> method_columns(const cases::Case& setup,
                                   const std::vector<std::string>& methods);

/// Names of variants of the file that set a key that --set says something of.
std::vector<std::string> overridden_variants(const cases::Case& setup);

/// Those of the variants: of the file first, without those of whose keys --set says something, then
/// as they were asked for.
/// @throws base::InputError  see cases::add_variant; on settings that the case cannot be read with,
///         or has by itself, and on a variant of a method that is not among `methods`
std::vector<Column> variant_columns(const cases::Case& setup,
                                    const std::vector<std::string>& methods,
                                    const VariantRequest& request);

}  // namespace diptych::harness
