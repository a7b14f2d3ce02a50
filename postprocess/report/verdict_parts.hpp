#pragma once
/// What the sentences of a verdict are made of. Test: tests/report/verdict_test.cpp

#include "postprocess/report/study_report.hpp"

#include <string>
#include <vector>

namespace diptych::report {

/// The relative L2 error, NaN where it was not measured.
double error_of(const io::RunSummary& run, const std::string& field);

/// "a, b and c"
std::string names_html(const std::vector<std::string>& names);

/// Both methods up to the finest level that both have finished.
struct Pair {
  std::vector<io::RunSummary> first, second;  ///< coarse to fine, the same last level
  const io::RunSummary& a() const { return first.back(); }
  const io::RunSummary& b() const { return second.back(); }
  std::vector<std::string> fields() const;  ///< with an error of both at that level
};

/// Largest size that a quantity has over the run, so that one that ends near zero is not judged by
/// its last value; of an energy or a dissipation the largest energy that there is.
double scale_of(const StudyReport& study,
                const std::string& name,
                const std::string& unit,
                const std::vector<GridSeries>& series);

/// Whether the quantities agree; without errors, first of all which method is nearer to
/// convergence.
std::vector<std::string> agreement_sentences(const StudyReport& study,
                                             const Pair& pair,
                                             bool has_errors);

}  // namespace diptych::report
