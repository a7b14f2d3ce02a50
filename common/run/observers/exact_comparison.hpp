#pragma once
/// The run against the exact solution of its case at the output times: error norms, and what the
/// exact solution gives for exact.csv and the report: kinetic energy and linear momentum by the
/// nodal volumes of the run, and the probes whose fields it has.
/// Test: tests/harness/exact_record_test.cpp

#include "common/io/run_record.hpp"
#include "common/run/exact_errors.hpp"
#include "common/run/observers/observer.hpp"
#include "common/run/probes.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::run {

class ExactComparison : public Observer {
 public:
  /// @param setup, solver, probes  kept by reference
  /// @param survey  place of its ExactSurvey in the solver, where the case has an exact solution
  ExactComparison(const cases::Case& setup,
                  const Solver& solver,
                  size_t survey,
                  const Probes& probes,
                  const NaturalSizes& sizes);

  /// Does nothing where the case has no exact solution.
  void at_output(const Output& output) override;
  void archive(algebra::Archive& archive) override;

  /// What is to be told of fields that the exact solution leaves at rest.
  std::optional<std::string> notice() const;
  const ExactErrors& errors() const { return errors_; }
  /// Time first, the names and units of history.csv, without momenta that are zero throughout;
  /// empty where the case has no exact solution.
  std::vector<io::HistoryColumn> columns() const;

 private:
  bool is_available() const { return ExactSurvey::is_for(setup_); }
  ExactSurvey& survey() const { return static_cast<ExactSurvey&>(solver_.survey(survey_)); }
  void add_row(double time, const ExactSums& sums);

  const cases::Case& setup_;
  const Solver& solver_;
  size_t survey_;
  const Probes& probes_;
  ExactErrors errors_;
  std::vector<io::HistoryColumn> columns_;
  double momentum_scale_ = 0;  ///< kg m/s, largest sum of |p| over the nodes
};

}  // namespace diptych::run
