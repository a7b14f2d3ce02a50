#pragma once
/// Error norms of a run against the exact solution of its case. The L2 norm of an error e relative
/// to a field f is
///   sqrt(sum Omega |e|^2) / max over output times of sqrt(sum Omega |f|^2),
/// so that an instant at which the exact field passes through zero does not blow the figure up. Of
/// a field that is zero at all of them, or rounding, it is relative to one of the natural size
/// throughout: the speed of pressure waves, the size of the body, rho c_p^2, strains of one.
/// Test: tests/harness/exact_record_test.cpp

#include "common/io/run_record.hpp"
#include "common/run/exact_survey.hpp"

#include <map>
#include <string>
#include <vector>

namespace diptych::run {

/// What fields of a body are measured with that are zero but for rounding.
struct NaturalSizes {
  double speed = 0;   ///< m/s
  double length = 0;  ///< m
  double stress = 0;  ///< Pa
  double volume = 0;  ///< m^3
};

/// @param speed  of pressure waves of the undeformed body, m/s
NaturalSizes natural_sizes(const cases::Case& setup, const scheme::PairGraph& graph, double speed);

class ExactErrors {
 public:
  explicit ExactErrors(const NaturalSizes& sizes) : sizes_(sizes) {}

  /// Of the sums at an output time; scales grow with every call.
  void measure(const ExactSums& sums);
  /// Norms of the last sums by field name, relative to the scales seen so far.
  std::map<std::string, io::ErrorNorms> relative() const;
  /// L2 norms of the first sums, relative to the scales seen so far; 0 where these are.
  std::map<std::string, double> relative_at_first() const;
  /// Fields that are zero so far or rounding, as the exact solution has them.
  std::vector<std::string> at_rest() const;
  /// The largest L2 norm of each exact field so far.
  std::map<std::string, double> scales() const;
  /// Norms and scales so far.
  void archive(algebra::Archive& archive);

 private:
  struct Norms {
    io::ErrorNorms error, scale;
    double first = -1;  ///< L2 norm of the first error; below zero where there is none
  };
  io::ErrorNorms natural_norms(const std::string& field) const;
  bool is_at_rest(const std::string& field, const Norms& norms) const;

  NaturalSizes sizes_;
  std::map<std::string, Norms> norms_;
};

}  // namespace diptych::run
