#pragma once
/// Error norms of a run against the exact solution of its case. Norms are weighted by the nodal
/// volumes; the L2 norm of an error e relative to a field f is
///   sqrt(sum Omega |e|^2) / max over output times of sqrt(sum Omega |f|^2),
/// so that an instant at which the exact field passes through zero does not blow the figure up.
/// F, H, A and S are measured against their difference from I, J against J - 1.

#include "common/cases/case.hpp"
#include "common/functions/placed_values.hpp"
#include "common/io/run_record.hpp"
#include "common/run/solver.hpp"

#include <map>
#include <optional>
#include <string>

namespace diptych::run {

using algebra::Mat3;

class ExactErrors {
 public:
  ExactErrors(const cases::Case& setup, const scheme::PairGraph& graph, const Solver& solver);

  /// Whether the case has an exact solution at all.
  bool available() const {
    return setup_.motion || setup_.exact.displacement || setup_.exact.velocity;
  }
  /// Compares a snapshot; scales grow with every call.
  /// @return the exact fields at its time; those that the case does not give are empty
  Snapshot measure(const Snapshot& snapshot);
  /// Norms of the last snapshot by field name, relative to the scales seen so far.
  std::map<std::string, io::ErrorNorms> relative() const;
  /// The largest L2 norm of each exact field so far.
  std::map<std::string, double> scales() const;
  /// Norms and scales so far; not the fields of the last snapshot.
  void archive(algebra::Archive& archive);
  /// Size of the error at each node in the last snapshot by field name, absolute.
  const std::map<std::string, std::vector<double>>& nodal() const { return nodal_; }

 private:
  struct Norms {
    io::ErrorNorms error, scale;
  };
  template <class Field>
  void measure_field(const std::string& name,
                     const std::vector<const std::vector<Field>*>& fields,
                     const std::vector<const std::vector<Field>*>& exact,
                     const Field& rest);
  Snapshot exact_snapshot(double t);
  std::vector<Mat3> exact_deformation_gradients(double t);
  std::vector<Mat3> differences_of_displacement(double t) const;

  const cases::Case& setup_;
  const scheme::PairGraph& graph_;
  const Solver& solver_;
  std::optional<functions::PlacedExpressions> placed_;  ///< of [exact] at the nodes
  std::optional<functions::PlacedValues> gradients_;    ///< of its displacement, where it has any
  bool is_placed_ = false;                              ///< whether gradients_ was looked for
  std::map<std::string, Norms> norms_;
  std::map<std::string, std::vector<double>> nodal_;
};

}  // namespace diptych::run
