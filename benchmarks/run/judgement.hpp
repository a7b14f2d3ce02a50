#pragma once
/// What a run is worth: stable, stopped by the program, or wrong, which is worse than both: it came
/// to its end while its budget, its cells or a bound of its case say that it is no solution.
/// Test: tests/harness/judgement_test.cpp

#include "common/cases/case.hpp"
#include "common/io/run_record.hpp"

#include <map>
#include <string>
#include <vector>

namespace diptych::harness {

/// What D_ab has dissipated at the end as a share of RunSummary::largest_energy; 0 of a body
/// without energy.
double numerical_share(const io::RunSummary& run);

/// Numbers of a run that bounds may be asked of, by name: "energy residual" (its magnitude at the
/// end), "inverted cells" (the most at any output), "least cell J", "least J", "kinetic growth"
/// (the greatest kinetic energy of any output over that of the start: noise on a body at rest must
/// not exceed 1), "numerical share" (numerical_share), drifts of the momenta, and what
/// run_quantities.hpp has of a run and its probes.
std::map<std::string, double> run_figures(const io::RunSummary& run,
                                          const std::vector<io::HistoryRow>& history);

/// What is asked of every run that comes to its end: an energy residual of at most 1e-2 and no cell
/// inside out at any output.
const std::vector<cases::BoundCase>& guard_bounds();

/// A bound and what a run came to.
struct AskedBound {
  cases::BoundCase bound;
  double measured = 0;

  bool is_met() const { return bound.is_met_by(measured); }
  std::string text() const;  ///< "energy residual 0.036, asked <= 0.01"
};

/// Those of the guards, then `bounds`.
/// @throws base::InputError for a figure that the run does not have, with those that it has
std::vector<AskedBound> asked_of(const io::RunSummary& run,
                                 const std::vector<io::HistoryRow>& history,
                                 const std::vector<cases::BoundCase>& bounds);

/// What the pass numbers of a case ([expect]) ask of a run that came to its end and does not hold,
/// as a text for people; empty where all does or the case asks nothing.
/// @throws base::InputError for a figure that the run does not have
std::string unmet_of(const cases::ExpectCase& expect,
                     const io::RunSummary& run,
                     const std::vector<io::HistoryRow>& history);

/// @throws base::InputError for a figure in the pass numbers of a case that its runs will not have
void check_figures(const cases::Case& setup);

enum class Outcome {
  stable,     ///< came to its end, every bound holds
  stopped,    ///< code 3
  wrong,      ///< came to its end, a bound does not hold
  refused,    ///< code 2: could not be begun
  unfinished  ///< its step limit ended it before the end of its case: that says nothing of the rest
};
const char* word_of(Outcome outcome);

struct Judgement {
  Outcome outcome = Outcome::refused;
  std::string reason;  ///< first line of the message, or the bounds that do not hold
};

Judgement judged(const io::RunSummary& run,
                 const std::vector<io::HistoryRow>& history,
                 const std::vector<cases::BoundCase>& bounds);

}  // namespace diptych::harness
