#pragma once
/// Error norms of a run against the exact solution of its case. The L2 norm of an error e relative
/// to a field f is
///   sqrt(sum Omega |e|^2) / max over output times of sqrt(sum Omega |f|^2),
/// so that an instant at which the exact field passes through zero does not blow the figure up.

#include "common/io/run_record.hpp"
#include "common/run/exact_survey.hpp"

#include <map>
#include <string>

namespace diptych::run {

class ExactErrors {
 public:
  /// Of the sums at an output time; scales grow with every call.
  void measure(const ExactSums& sums);
  /// Norms of the last sums by field name, relative to the scales seen so far.
  std::map<std::string, io::ErrorNorms> relative() const;
  /// L2 norms of the first sums, relative to the scales seen so far; 0 where these are.
  std::map<std::string, double> relative_at_first() const;
  /// The largest L2 norm of each exact field so far.
  std::map<std::string, double> scales() const;
  /// Norms and scales so far.
  void archive(algebra::Archive& archive);

 private:
  struct Norms {
    io::ErrorNorms error, scale;
    double first = -1;  ///< L2 norm of the first error; below zero where there is none
  };
  std::map<std::string, Norms> norms_;
};

}  // namespace diptych::run
