#pragma once
/// The quantities of a study: what the probes of a case come to, its energies, least J, what a run
/// cost, for every variant, method and level; as text for a terminal, CSV, and a page of plots
/// against the parameter that varies. Test: tests/harness/variant_quantities_test.cpp

#include "benchmarks/run/run_quantities.hpp"
#include "benchmarks/study/study_verb.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// All of a run: of each probe the value at the end, extremes and, where it oscillates, period and
/// amplitude; energies at the end; least J, energy residual, steps, nodes, seconds of the time
/// loop.
std::vector<RunQuantity> quantities_of_run(const WorkPoint& point);

/// One of them; NaN where the run does not have it.
double value_of(const WorkPoint& point, const std::string& quantity);

/// @param wanted  of --quantity: a name, the name of a probe (all of it), or 'all'
/// @throws base::InputError for a name that the case does not have, with those it has
void check_quantities(const cases::Case& setup, const std::vector<std::string>& wanted);

/// Names of the quantities to show. By default all but steps and nodes, energies that are zero in
/// every run, and what no run has.
std::vector<std::string> chosen_quantities(const cases::Case& setup,
                                           const std::vector<std::string>& wanted,
                                           const StudyRuns& runs);

struct VariantStudy {
  std::vector<WorkCurve> curves;
  std::vector<Variant> variants;
  std::vector<std::string> quantities;  ///< names, in the order of the tables
};

/// A block for each quantity: a row for each variant, a column for each method and level; at most
/// 100 columns wide.
std::string quantities_table(const VariantStudy& study);

/// A line for each variant, method and level, with the keys that vary and every quantity, whichever
/// are shown.
std::string quantities_csv(const VariantStudy& study);

/// How far the methods are apart on the finest level that both have, in one or two sentences
/// (HTML).
std::string quantities_verdict(const VariantStudy& study);

/// Plots against the first key that varies over numbers, else against the spacing, and the table.
std::string quantities_html(const std::string& title, const VariantStudy& study);

}  // namespace diptych::harness
