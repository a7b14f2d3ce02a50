#pragma once
/// Regression: every case of a folder with both methods at a small size, against what was recorded
/// of it (the shipped ones in benchmarks/baselines) and against what must hold anywhere. Per
/// method:
///
///   canary        five steps with a stated time.cfl: norm and projection of every field
///   errors        norms of the errors, where the case has an exact solution
///   quantities    probes, energies, least J, numbers of nodes, pairs and steps
///   conservation  momenta, energy residual, signs of both dissipations; needs no baseline
///   dissipation   share of the energy that D_ab dissipates, at most that of [bounds]
///   reference     distance from values from elsewhere, at most the uncertainty that they state,
///                 on the finest level of the baseline
///
/// A case with pass numbers of its own (section [expect]) is asked for them at the size it stands
/// in, `expect`, and needs no baseline: a baseline would pin what is to be mended.
///
/// What was not met of the last two when the baseline was recorded is known, shown with its figure,
/// and must not grow; what was met must stay so.
///
/// and of both: `agreement`, |SPH - FVM| of each scalar on level 1 within the sum of their error
/// bars from levels 0 and 1 (Roache's factor 3 with the formal order); what was recorded apart is
/// known while it does not grow, told with the case's [[apart]] or with the wish for one. No bound
/// is an option. Tests: tests/harness/regress_test.cpp, tests/harness/expectation_test.cpp,
/// tests/command_line/regress_test.cpp

#include "common/base/error.hpp"
#include "common/cases/case.hpp"
#include "common/io/run_record.hpp"

#include <map>
#include <string>
#include <vector>

namespace diptych::harness {

/// A number and the size against which its change is judged, > 0 unless both are zero.
struct RegressFigure {
  double value = 0, scale = 0;
};
using RegressFigures = std::map<std::string, RegressFigure>;

/// What a run of one method comes to.
struct MethodFigures {
  std::string state;                          ///< hash after the five steps
  RegressFigures canary, errors, quantities;  ///< by name
  std::map<std::string, double> unmet;        ///< bound or reference: figure over its bound, > 1
};

/// Scalars of both methods on level 1.
struct AgreementFigure {
  double sph = 0, fvm = 0;
  double bars = 0;  ///< sum of the error bars of both
  double excess() const;
};

struct RegressPlatform {
  std::string instruction_set, compiler, flags;
  bool operator==(const RegressPlatform& other) const;
};
RegressPlatform this_platform();

/// The size at which a case is run, and what was recorded of it: one file of benchmarks/baselines.
struct RegressBaseline {
  std::string case_name, reason, commit, date;
  RegressPlatform platform;
  std::vector<std::string> set;  ///< "key=value": what makes the case small
  int levels = 1;                ///< 2: levels 0 and 1
  std::string one_level_because;
  std::map<std::string, MethodFigures> methods;
  std::map<std::string, double> disagreement;  ///< scalar: |SPH - FVM| over the bars, where > 1
};

/// JSON. @throws base::InputError where a figure is not finite (it cannot be a baseline)
std::string to_json(const RegressBaseline& baseline);
/// @throws base::InputError on malformed text, a missing or unknown key, what is no finite number
RegressBaseline baseline_from_json(const std::string& text, const std::string& path);

enum class Verdict { met, known, failed, skipped };

/// One comparison: `measured` must not exceed `bound`, or fall below it.
struct RegressCheck {
  std::string name, figure;  ///< "canary"; "velocity norm"
  Verdict verdict = Verdict::failed;
  double measured = 0, bound = 0;
  std::string note;  ///< why skipped, or what is wrong besides numbers
  base::ExitCode code = base::ExitCode::bound_not_met;  ///< what it means where it failed
  bool at_least = false;                                ///< the bound is one from below
};
/// Name of the checks that [expect] asks for, of those that [bounds] does, and of references.
inline constexpr const char *expect_check = "expect", *dissipation_check = "dissipation",
                            *reference_check = "reference";
/// A failure that no number shows.
RegressCheck failure(const std::string& name,
                     const std::string& figure,
                     const std::string& note,
                     base::ExitCode code = base::ExitCode::bound_not_met);
/// True only for finite numbers within the bound.
RegressCheck checked(const std::string& name,
                     const std::string& figure,
                     double measured,
                     double bound,
                     const std::string& note = {});

struct MethodMeasurement {
  MethodFigures figures;
  std::vector<RegressCheck> conservation;
  std::vector<RegressCheck> asked;  ///< of [bounds] and [[reference]], whatever is known
  std::string failure;              ///< of a run that broke down or that its step limit ended
  base::ExitCode failure_code = base::ExitCode::breakdown;  ///< of the failure
  double seconds = 0;
};

struct RegressMeasurement {
  std::map<std::string, MethodMeasurement> methods;
  std::map<std::string, AgreementFigure> agreement;
  std::string no_agreement;                         ///< why there is none
  std::map<std::string, std::string> explanations;  ///< quantity: [[apart]] of the case
};

/// Runs a case at the size of its baseline.
/// @param overrides  after those of the size
RegressMeasurement measure_regress(const std::string& case_file,
                                   const RegressBaseline& size,
                                   const std::vector<std::string>& overrides,
                                   int threads);

/// A figure that either side lacks and one that is not finite are failures.
std::vector<RegressCheck> compare_figures(const std::string& check,
                                          const RegressFigures& recorded,
                                          const RegressFigures& now,
                                          double relative_bound);

/// All checks of one method.
std::vector<RegressCheck> checks_of(const MethodFigures& recorded,
                                    const MethodMeasurement& now,
                                    bool same_platform);

/// What was beyond the bars when it was recorded is `known` as long as it does not grow and the
/// case says why.
std::vector<RegressCheck> agreement_checks(const RegressBaseline& recorded,
                                           const RegressMeasurement& now);

/// A run that [expect] asks for: a method with a variant of the case, or "" for the case itself.
struct ExpectedRun {
  std::string method, variant;
};
std::vector<ExpectedRun> expected_runs(const cases::ExpectCase& expect);

/// What such a run came to beside what is asked of it. What does not meet the pass numbers is
/// `known` where the case says so in [[expect.unmet]] and it ends as is said there; where they are
/// met in spite of such an entry the check fails: an entry that nobody removes would hide the next
/// time that they are not.
std::vector<RegressCheck> expectation_checks(const cases::ExpectCase& expect,
                                             const ExpectedRun& asked,
                                             const io::RunSummary& run,
                                             const std::vector<io::HistoryRow>& history);

/// The pass numbers of a case of one method: its runs, made here, and their seconds.
struct ExpectationMeasurement {
  std::vector<RegressCheck> checks;
  double seconds = 0;
};
/// @return by method; not all after an interrupt
std::map<std::string, ExpectationMeasurement> measure_expectations(const cases::Case& setup,
                                                                   int threads);

/// Folder of the baselines.
/// @param asked  of --baselines; empty: the environment variable DIPTYCH_BASELINES, else the
///               program's data
std::string baselines_folder(const std::string& asked = {});

}  // namespace diptych::harness
