#pragma once
/// The run against the exact solution of its case, each rank for its own nodes: sums over the
/// chunks of nodes, whose order does not depend on the ranks. Norms are weighted by the nodal
/// volumes. Test: tests/common/run/exact_survey_test.cpp

#include "common/run/exact_fields.hpp"
#include "common/run/solver.hpp"
#include "common/run/survey.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>

namespace diptych::run {

/// Names of what is compared, by their places in the sums. F, H, A and S are measured against their
/// difference from I, J against J - 1. Branches add in squares.
const std::array<std::string, 8>& compared_fields();

/// Of the error of a field and of the exact field, over nodes.
struct SizeSums {
  double l1 = 0, l2 = 0, linf = 0;  ///< of weighted sizes, of their squares, the largest
  void add(double weight, double size);
  void add(const SizeSums& other);
};
struct FieldSums {
  SizeSums error, exact;
};
/// Of nodes, or of the whole body.
struct ExactSums {
  std::array<bool, 8> has{};  ///< the fields that the exact solution gives
  std::array<FieldSums, 8> fields;
  // of the exact velocities
  bool has_velocity = false;
  double kinetic = 0;            ///< J
  Vec3 momentum = Vec3::Zero();  ///< kg m/s
  double momentum_scale = 0;     ///< kg m/s, sum of |p|
  void add(const ExactSums& other);
};

class ExactSurvey : public Survey {
 public:
  /// Whether a case has an exact solution at all.
  static bool is_for(const cases::Case& setup) {
    const cases::ExactCase& exact = setup.exact;
    return setup.motion || exact.displacement || exact.velocity || exact.deformation_gradient ||
           exact.stress;
  }

  /// Nodes of the chunks of this rank, chunk after chunk.
  struct Nodes {
    std::vector<Vec3> X;        ///< m
    std::vector<double> Omega;  ///< m^3
    double length = 0;          ///< m, of the volume of the first node of the body
  };

  /// @param setup   kept by reference
  /// @param solver  of this rank, kept by reference
  ExactSurvey(const cases::Case& setup, const Solver& solver, Nodes nodes);
  /// Of a body that is not divided. @param graph  nodes and volumes are copied
  ExactSurvey(const cases::Case& setup, const Solver& solver, const scheme::PairGraph& graph);

  /// This rank is to know the exact fields at these nodes, too.  @param X  their places, m
  void read_at(std::vector<std::int32_t> nodes, std::vector<Vec3> X);

  /// No question; sums of each chunk, for sums_of().
  std::vector<double> answer(const Solver& solver, std::span<const double> question) override;
  /// At the nodes of read_at(), when it was last asked.
  const Snapshot& at_nodes() const { return at_nodes_; }

 private:
  ExactFields fields_at(std::vector<Vec3> X) const;

  const cases::Case& setup_;
  const Solver& solver_;
  double length_;  ///< m, see Nodes
  std::vector<double> Omega_;
  std::vector<std::int64_t> place_of_chunk_;  ///< [n_chunks] among those of this rank
  std::vector<std::int32_t> read_;
  std::optional<ExactFields> exact_, exact_at_read_;  ///< of expressions
  Snapshot at_nodes_;
};

/// Of the volume of the first node of a body  [m]
double length_of(const scheme::PairGraph& graph);

/// Sums over the body, in the order of the chunks.
ExactSums sums_of(const Answers& answers);

/// Size of the error at each node by field name, absolute.
/// @param exact  fields that it lacks are left out
std::map<std::string, std::vector<double>> nodal_errors(const cases::Case& setup,
                                                        const Snapshot& state,
                                                        const Snapshot& exact);

}  // namespace diptych::run
