#pragma once
/// Internal variables A = C_v^-1, S = G_v^-1 of a known motion and their gradients by X, from (14):
///   A' = (C^-1 - A)/tau,   (grad A)' = (grad C^-1 - grad A)/tau,
/// linear with C^-1(t) known, so that an exponential Gauss rule integrates them to about 1e-13 for
/// every dt/tau. Times are asked for in the order of a step (t, t + dt, t + dt/2, t + dt, ...): the
/// states of the last three times are kept, a new one costs one short interval from the nearest
/// before it. Test: tests/common/exact/manufactured_test.cpp.

#include "common/algebra/archive.hpp"
#include "common/exact/manufactured/exponential_gauss.hpp"
#include "common/exact/manufactured/motion.hpp"
#include "common/physics/maxwell_branch.hpp"

#include <array>

namespace diptych::exact {

template <int Dim>
class ViscousHistory {
 public:
  using Scalar = algebra::Dual<Lanes, Dim>;
  using Branch = physics::BranchState<Scalar>;

  /// @param motion   outlives this
  /// @param X        [n_nodes] m, reference positions
  /// @param relaxed  A(0) = C(0)^-1, S(0) = G(0)^-1 (true) or A(0) = S(0) = I
  /// @param end      s, time up to which the accuracy is verified
  /// @throws base::InputError where no interval is short enough: the motion is not smooth
  ViscousHistory(const Motion& motion,
                 std::span<const Vec3> X,
                 std::vector<physics::MaxwellBranch> branches,
                 bool relaxed,
                 double end);

  /// Fastest from the last times on; from 0 where t lies before them.
  void move_to(double t);

  /// Branches of a block at the last time.
  const Branch* at(std::int64_t block) const {
    return &states_[now_].branches[block * n_branches()];
  }
  /// The last times and the branches there: what move_to() goes on from.
  void archive(algebra::Archive& archive);
  std::int64_t n_branches() const { return static_cast<std::int64_t>(branches_.size()); }

 private:
  /// Branches that relax with the same time.
  struct Clock {
    double tau;
    std::vector<int> C, G;  ///< of A, of S
  };
  /// A rule with the longest interval over which it is exact enough.
  struct Accuracy {
    int n_points;
    double longest;  ///< s
  };
  struct State {
    double time;
    std::int64_t used;             ///< when it was last asked for; 0: it holds nothing
    std::vector<Branch> branches;  ///< [block][branch]
  };
  struct Plan;

  ViscousHistory(const ViscousHistory& other, std::span<const Vec3> X, Accuracy accuracy);
  void restart();
  void calibrate(double end, std::span<const Vec3> X);
  double longest_interval(int n_points, double end, int most, std::span<const Vec3> sample) const;
  Plan plan(double from, double to) const;
  DIPTYCH_CLONES void relax(const functions::PlacedProgram::Instant& start,
                            std::int64_t strip,
                            functions::PlacedProgram::Workspace& workspace);
  DIPTYCH_CLONES void integrate(const Plan& plan,
                                const State& from,
                                State& to,
                                std::int64_t strip,
                                functions::PlacedProgram::Workspace& workspace) const;

  const Motion* motion_;
  functions::PlacedProgram placed_;
  std::vector<physics::MaxwellBranch> branches_;
  std::vector<Clock> clocks_;
  std::vector<Accuracy> accuracies_;  ///< fewest points first
  bool relaxed_;
  std::array<State, 3> states_;
  size_t now_ = 0;
  std::int64_t n_asked_ = 0;
};

extern template class ViscousHistory<2>;
extern template class ViscousHistory<3>;

}  // namespace diptych::exact
