#pragma once
/// What a study says, in a few sentences of plain words for the top of its page: what broke down,
/// which method errs less and at what cost, whether the methods agree, of the quantities that both
/// resolve (grid_convergence.hpp). Where they are further apart than half of the scale the study is
/// too coarse to say.
/// Test: tests/report/verdict_test.cpp

#include "postprocess/report/agreement.hpp"
#include "postprocess/report/study_report.hpp"

#include <string>
#include <vector>

namespace diptych::report {

/// Part of the scale from which on two values are too far apart for a verdict.
constexpr double too_far_apart = 0.5;

/// Sentences in HTML, the most important first; at least one.
std::vector<std::string> verdict(const StudyReport& study);

/// "0.35 %"
std::string percent_html(double part);

/// "finite volume", or "finite volume sbp" of a variant, as it stands within a sentence.
std::string column_in_sentence(const std::string& column);

/// Those of the methods at the settings of the case, which a verdict is on.
std::vector<GridSeries> series_of_methods(const std::vector<GridSeries>& series);

/// With a capital letter.
std::string at_the_start(std::string sentence);

// What the sentences are made of.

/// "a, b and c"
std::string names_html(const std::vector<std::string>& names);

/// Both methods up to the finest level that both have finished.
struct Pair {
  std::vector<io::RunSummary> first, second;  ///< coarse to fine, the same last level
  const io::RunSummary& a() const { return first.back(); }
  const io::RunSummary& b() const { return second.back(); }
  std::vector<std::string> fields() const;  ///< with an error of both at that level
};

/// On a quantity that both methods have.
Verdict verdict_on(const GridSeries& a, const GridSeries& b);

/// The larger of the sizes that a quantity has over the runs, so that one that ends near zero is
/// not judged by its last value.
double scale_of(const std::vector<GridSeries>& series);

/// Whether the quantities agree; without errors, first of all which method is nearer to
/// convergence.
std::vector<std::string> agreement_sentences(const StudyReport& study,
                                             const Pair& pair,
                                             bool has_errors);

}  // namespace diptych::report
