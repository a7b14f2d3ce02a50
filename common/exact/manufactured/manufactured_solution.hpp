#pragma once
/// Everything that follows from a given motion: F, H, J, A, S, P, and the body force
///   f = rho_R d2x/dt2 - DIV P.
/// DIV P comes from the physics itself with a scalar that carries its gradient (Dual), so that no
/// formula is written twice. Test: tests/common/exact/manufactured_test.cpp.

#include "common/exact/manufactured/viscous_history.hpp"
#include "common/scheme/body/model.hpp"
#include "common/scheme/body/snapshot.hpp"
#include "common/scheme/boundary/known_loads.hpp"

#include <functional>

namespace diptych::exact {

using algebra::Mat3;
using algebra::Vec3;

/// The exact state of a manufactured solution, and the loads that make it one.
class KnownState : public scheme::KnownLoads {
 public:
  /// All fields at time t.
  virtual scheme::Snapshot snapshot(double t) = 0;
  /// What depends on the times that it was moved to before; where it is loading it is then at the
  /// last of these.
  virtual void archive(algebra::Archive& archive) = 0;
};

template <int Dim>
class ManufacturedSolution : public KnownState {
 public:
  using Scalar = algebra::Dual<Lanes, Dim>;
  using Branch = physics::BranchState<Scalar>;
  /// P of eight nodes with its gradient, from F and the branches.
  using Stress = std::function<void(
      const algebra::Tensor<Scalar>& F, const Branch* branches, algebra::Tensor<Scalar>& P)>;

  /// @param X    [n_nodes] m, reference positions
  /// @param end  s, end of the run
  ManufacturedSolution(std::shared_ptr<const Motion> motion,
                       const std::vector<Vec3>& X,
                       std::vector<physics::MaxwellBranch> branches,
                       double rho_R,
                       bool relaxed,
                       double end,
                       Stress stress);

  /// @throws base::InputError where J <= 0 or a value is not finite
  void move_to(double t) override;
  const Vec3& body_force(std::int64_t node) const override { return body_force_[node]; }
  const Mat3& stress(std::int64_t node) const override { return P_[node]; }
  scheme::Snapshot snapshot(double t) override;
  void archive(algebra::Archive& archive) override;

 private:
  DIPTYCH_CLONES void evaluate(std::int64_t begin, std::int64_t end);
  void check() const;

  std::shared_ptr<const Motion> motion_;
  std::vector<Vec3> X_;
  std::vector<LanePlace> places_;
  double rho_R_;
  Stress stress_of_;
  ViscousHistory<Dim> history_;
  double time_;
  std::vector<Jet<double, 1>> at_time_;
  std::vector<Vec3> body_force_;
  std::vector<Mat3> F_, P_;
};

extern template class ManufacturedSolution<2>;
extern template class ManufacturedSolution<3>;

/// P of a model with all its branches.
template <int Dim, class Material>
DIPTYCH_CLONES void stress_of_block(const scheme::Model<Material>& model,
                                    const algebra::Tensor<algebra::Dual<Lanes, Dim>>& F,
                                    const physics::BranchState<algebra::Dual<Lanes, Dim>>* branches,
                                    algebra::Tensor<algebra::Dual<Lanes, Dim>>& P) {
  constexpr bool has_H = Material::has_H;
  const auto X = physics::deformation_of(F);
  auto response = model.material.response(X);
  for (size_t k = 0; k < model.branches.size(); ++k)
    physics::add_branch_response<has_H>(model.branches[k], branches[k], X, response);
  P = physics::piola_stress<has_H>(response, X);
}

/// The solution for a model.
template <int Dim, class Material>
std::shared_ptr<KnownState> manufactured_solution(std::shared_ptr<const Motion> motion,
                                                  const scheme::Model<Material>& model,
                                                  const std::vector<Vec3>& X,
                                                  bool relaxed,
                                                  double end) {
  const auto stress = [model](const auto& F, const auto* branches, auto& P) {
    stress_of_block<Dim>(model, F, branches, P);
  };
  return std::make_shared<ManufacturedSolution<Dim>>(std::move(motion), X, model.branches,
                                                     model.rho_R, relaxed, end, stress);
}

}  // namespace diptych::exact
