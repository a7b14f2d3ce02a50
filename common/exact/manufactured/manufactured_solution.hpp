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

/// What the stress of a block comes to.
template <int Dim>
struct BlockStress {
  Lanes divergence[Dim];     ///< DIV P  [Pa/m]
  algebra::Tensor<Lanes> P;  ///< Pa
  Lanes J;                   ///< -
};

template <int Dim>
class ManufacturedSolution : public KnownState {
 public:
  using Scalar = algebra::Dual<Lanes, Dim>;
  using Branch = physics::BranchState<Scalar>;
  /// Stress of eight nodes from F and the branches with their gradients.
  using Stress = std::function<void(
      const algebra::Tensor<Scalar>& F, const Branch* branches, BlockStress<Dim>& stress)>;

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
  const algebra::BlockField& body_forces() const override { return loads_[now_].body_forces; }
  Mat3 stress(std::int64_t node) const override;
  scheme::Snapshot snapshot(double t) override;
  void archive(algebra::Archive& archive) override;

 private:
  using Program = functions::PlacedProgram;

  /// What is kept of a time.
  struct Loads {
    double time;
    algebra::BlockField body_forces, P;  ///< N/m^3, Pa (nine components)
  };

  DIPTYCH_CLONES bool evaluate(std::int64_t strip,
                               double t,
                               const Program::Instant& instant,
                               const Branch* branches,
                               Program::Workspace& workspace,
                               Loads& loads);
  void put_deformations(double t, scheme::Snapshot& s) const;
  [[noreturn]] void refuse_strip(std::int64_t strip, double t) const;

  std::shared_ptr<const Motion> motion_;
  std::vector<Vec3> X_;
  double rho_R_;
  Stress stress_of_;
  ViscousHistory<Dim> history_;
  /// Of the last two times: a Runge-Kutta step asks for its end, then for its middle, and the next
  /// one begins at that end.
  std::array<Loads, 2> loads_;
  size_t now_ = 0;
};

extern template class ManufacturedSolution<2>;
extern template class ManufacturedSolution<3>;

/// F with its derivative by X_I; in plane strain the rest is known to be that of the identity.
template <int I, int Dim>
DIPTYCH_INLINE algebra::Tensor<algebra::Dual<Lanes, 1>> along(
    const algebra::Tensor<algebra::Dual<Lanes, Dim>>& F) {
  auto G = algebra::identity<algebra::Dual<Lanes, 1>>();
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j)
      G(i, j) = {F(i, j).v, {F(i, j).d[I]}};
  }
  return G;
}
template <int I, int Dim>
DIPTYCH_INLINE algebra::SymmetricTensor<algebra::Dual<Lanes, 1>> along(
    const algebra::SymmetricTensor<algebra::Dual<Lanes, Dim>>& A) {
  algebra::SymmetricTensor<algebra::Dual<Lanes, 1>> B;
  for (int s = 0; s < 6; ++s)
    B.s[s] = {A.s[s].v, {A.s[s].d[I]}};
  return B;
}

/// dP_iI/dX_I of one I, and with the first of them P and J. One direction at a time: all three with
/// the values once are as many operations, of which the registers do not hold the half.
template <int I, int Dim, class Material>
DIPTYCH_INLINE void add_divergence(const scheme::Model<Material>& model,
                                   const algebra::Tensor<algebra::Dual<Lanes, Dim>>& F,
                                   const physics::BranchState<algebra::Dual<Lanes, Dim>>* branches,
                                   BlockStress<Dim>& stress) {
  constexpr bool has_H = Material::has_H;
  const auto X = physics::deformation_of(along<I>(F));
  auto response = model.material.response(X);
  for (size_t k = 0; k < model.branches.size(); ++k) {
    const physics::BranchState<algebra::Dual<Lanes, 1>> state{along<I>(branches[k].A),
                                                              along<I>(branches[k].S)};
    physics::add_branch_response<has_H>(model.branches[k], state, X, response);
  }
  const auto P = physics::piola_stress<has_H>(response, X);
  for (int i = 0; i < Dim; ++i)
    stress.divergence[i] = I == 0 ? P(i, I).d[0] : stress.divergence[i] + P(i, I).d[0];
  if constexpr (I == 0) {
    for (int k = 0; k < 9; ++k)
      stress.P(k / 3, k % 3) = P(k / 3, k % 3).v;
    stress.J = X.J.v;
  }
}

/// Stress of a model with all its branches.
template <int Dim, class Material>
DIPTYCH_CLONES void stress_of_block(const scheme::Model<Material>& model,
                                    const algebra::Tensor<algebra::Dual<Lanes, Dim>>& F,
                                    const physics::BranchState<algebra::Dual<Lanes, Dim>>* branches,
                                    BlockStress<Dim>& stress) {
  add_divergence<0>(model, F, branches, stress);
  add_divergence<1>(model, F, branches, stress);
  if constexpr (Dim == 3) add_divergence<2>(model, F, branches, stress);
}

/// The solution for a model.
template <int Dim, class Material>
std::shared_ptr<KnownState> manufactured_solution(std::shared_ptr<const Motion> motion,
                                                  const scheme::Model<Material>& model,
                                                  const std::vector<Vec3>& X,
                                                  bool relaxed,
                                                  double end) {
  const auto stress = [model](const auto& F, const auto* branches, auto& result) {
    stress_of_block<Dim>(model, F, branches, result);
  };
  return std::make_shared<ManufacturedSolution<Dim>>(std::move(motion), X, model.branches,
                                                     model.rho_R, relaxed, end, stress);
}

}  // namespace diptych::exact
