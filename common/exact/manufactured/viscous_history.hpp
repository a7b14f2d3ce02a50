#pragma once
/// Internal variables A = C_v^-1, S = G_v^-1 of a known motion and their gradients by X, from (14):
///   A' = (C^-1 - A)/tau,   (grad A)' = (grad C^-1 - grad A)/tau,
/// linear with C^-1(t) known, so that an exponential Gauss rule integrates them to about 1e-13 for
/// every dt/tau. Times are asked for in the order of a step (t, t + dt, t + dt/2, t + dt, ...):
/// each costs one short interval. Test: tests/common/exact/manufactured_test.cpp.

#include "common/algebra/archive.hpp"
#include "common/exact/manufactured/exponential_gauss.hpp"
#include "common/exact/manufactured/motion.hpp"
#include "common/physics/maxwell_branch.hpp"

namespace diptych::exact {

/// Reference positions of eight nodes.
struct alignas(sizeof(Lanes)) LanePlace {
  Lanes X[3];
};

template <int Dim>
class ViscousHistory {
 public:
  using Scalar = algebra::Dual<Lanes, Dim>;
  using Branch = physics::BranchState<Scalar>;

  /// @param motion   outlives this
  /// @param relaxed  A(0) = C(0)^-1, S(0) = G(0)^-1 (true) or A(0) = S(0) = I
  /// @param end      s, time up to which the accuracy is verified
  /// @throws base::InputError where no interval is short enough: the motion is not smooth
  ViscousHistory(const Motion& motion,
                 std::vector<LanePlace> places,
                 std::vector<physics::MaxwellBranch> branches,
                 bool relaxed,
                 double end);

  /// Fastest from the last time on, or from the one before; from 0 where t lies before both.
  void move_to(double t);

  /// Branches of a block at the last time.
  const Branch* at(std::int64_t block) const { return &latest_[block * n_branches()]; }
  /// The last time and the one before with the branches of both: what move_to() goes on from.
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
  using TimeValues = std::vector<Jet<double, 1>>;
  struct Plan;

  ViscousHistory(const ViscousHistory& other, std::vector<LanePlace> places, Accuracy accuracy);
  void restart();
  void calibrate(double end);
  double longest_interval(int n_points, double end, int most) const;
  Plan plan(double from, double to) const;
  DIPTYCH_CLONES void integrate(const Plan& plan, std::int64_t begin, std::int64_t end);

  const Motion* motion_;
  std::vector<LanePlace> places_;
  std::vector<physics::MaxwellBranch> branches_;
  std::vector<Clock> clocks_;
  std::vector<Accuracy> accuracies_;  ///< fewest points first
  bool relaxed_;
  double base_time_ = 0, latest_time_ = 0;
  std::vector<Branch> base_, latest_;  ///< [block][branch]
};

extern template class ViscousHistory<2>;
extern template class ViscousHistory<3>;

}  // namespace diptych::exact
