#pragma once
/// One point of a case's material, without a body: stress (9), energy (4)-(6), dissipation (12),
/// internal variables (14) by the updates of the solver, acoustic tensor (notes 2).
/// Test: tests/verification/material_paths_test.cpp.

#include "common/cases/case.hpp"
#include "common/scheme/body/material_model.hpp"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace diptych::run {

using algebra::Mat3;
using algebra::Vec3;
using PointBranch = physics::BranchState<double>;  ///< A = C_v^-1, S = G_v^-1

struct PointState {
  Mat3 F = Mat3::Identity();
  std::vector<PointBranch> branches;
};

class MaterialPoint {
 public:
  explicit MaterialPoint(std::shared_ptr<const scheme::MaterialModel> material)
      : material_(std::move(material)) {}
  Mat3 stress(const PointState& X) const;         ///< first Piola-Kirchhoff, Pa
  double energy(const PointState& X) const;       ///< Pa
  double dissipation(const PointState& X) const;  ///< W/m^3
  /// What the branches dissipate over a step, whatever dt/tau (notes 6.1).
  /// @param rates  of F at both ends  [1/s]; none: of a straight path of C and G
  /// @return J/m^3
  double dissipation_of_step(const PointState& begin,
                             const PointState& end,
                             double dt,
                             const std::optional<std::array<Mat3, 2>>& rates = {}) const;
  /// Of incremental waves in material direction N at frozen internal variables  [Pa]
  Mat3 acoustic_tensor(const PointState& X, const Vec3& N) const;

  const std::vector<physics::MaxwellBranch>& branches() const { return material_->branches(); }
  /// Branches at A = S = I.
  PointState virgin(const Mat3& F) const;
  /// A' and S' of (14) at this state  [1/s]
  std::vector<PointBranch> branch_rates(const PointState& X) const;

  /// Branches after dt while F goes from X.F to F_end: LIN of notes 5.2.
  std::vector<PointBranch> relaxed_linear(const PointState& X, const Mat3& F_end, double dt) const;
  /// The same by GEXP of notes 5.3, from the rates of F at both ends  [1/s].
  std::vector<PointBranch> relaxed_gauss(const PointState& X,
                                         const Mat3& rate_begin,
                                         const Mat3& F_end,
                                         const Mat3& rate_end,
                                         double dt) const;

 private:
  std::shared_ptr<const scheme::MaterialModel> material_;
};

MaterialPoint make_material_point(const cases::MaterialCase& material);

}  // namespace diptych::run
