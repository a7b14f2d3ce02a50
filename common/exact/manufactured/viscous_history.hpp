#pragma once
/// Internal variables A = C_v^-1, S = G_v^-1 of a known motion and their gradients by X, from (14):
///   A' = (C^-1 - A)/tau,   (grad A)' = (grad C^-1 - grad A)/tau,
/// linear with C^-1(t) known, so that an exponential Gauss rule integrates them to about 1e-13 for
/// every dt/tau: that of the longest tau, whose points the others take, too. Times are asked for in
/// the order of a step (t, t + dt, t + dt/2, t + dt, ...): the states of the three latest times are
/// kept, so that any of them, of a step that is made again too, is one short interval away; what
/// lies between them is not kept. Test: tests/common/exact/manufactured_test.cpp.

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
  /// @param results  of the motion that placed() evaluates besides its gradients
  /// @param X        [n_nodes] m, reference positions
  /// @param relaxed  A(0) = C(0)^-1, S(0) = G(0)^-1 (true) or A(0) = S(0) = I
  /// @param end      s, time up to which the accuracy is verified
  /// @throws base::InputError where no interval is short enough: the motion is not smooth
  ViscousHistory(const Motion& motion,
                 const std::vector<int>& results,
                 std::span<const Vec3> X,
                 std::vector<physics::MaxwellBranch> branches,
                 bool relaxed,
                 double end);

  /// From a state that is kept to another time.
  class Way;
  /// Fastest to times after the earliest of those kept; from 0 where t lies before them.
  Way way_to(double t);
  /// Goes a way with one strip. `room` is taken where the end of the way is not kept.
  /// @param room  [branches_of_strip()]
  /// @return the branches there  [branches_of_strip()]: [block][branch]
  const Branch* follow(const Way& way,
                       std::int64_t strip,
                       functions::PlacedProgram::Workspace& workspace,
                       Branch* room);
  /// After all strips have gone it.
  void arrive(const Way& way);

  /// Of all blocks at a time  [block][branch]; valid until the next call.
  const std::vector<Branch>& branches_at(double t);

  /// The times that are kept and the branches there.
  void archive(algebra::Archive& archive);
  std::int64_t n_branches() const { return static_cast<std::int64_t>(branches_.size()); }
  std::int64_t branches_of_strip() const { return placed_.width() * n_branches(); }
  /// Gradients of the motion, then the results.
  const functions::PlacedProgram& placed() const { return placed_; }

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
    double time = 0;
    std::vector<Branch> branches;  ///< [block][branch]; empty: it holds nothing
    bool holds() const { return !branches.empty(); }
  };

  ViscousHistory(const ViscousHistory& other, std::span<const Vec3> X, Accuracy accuracy);
  void restart();
  void calibrate(double end, std::span<const Vec3> X);
  std::vector<double> errors_of(int n_points,
                                double length,
                                std::span<const double> begins,
                                std::span<const Vec3> sample) const;
  const std::vector<Branch>& taken_in(double begin, double length);
  void plan(Way& way) const;
  DIPTYCH_CLONES void relax(const functions::PlacedProgram::Instant& start,
                            std::int64_t strip,
                            functions::PlacedProgram::Workspace& workspace);

  DIPTYCH_CLONES void integrate(const Way& way,
                                std::int64_t strip,
                                functions::PlacedProgram::Workspace& workspace,
                                const Branch* from,
                                Branch* to) const;

  const Motion* motion_;
  functions::PlacedProgram placed_;
  std::vector<physics::MaxwellBranch> branches_;
  std::vector<Clock> clocks_;
  std::vector<Accuracy> accuracies_;  ///< fewest points first
  bool relaxed_;
  std::array<State, 3> states_;
  std::vector<Branch> passing_;  ///< at a time that is not kept
};

/// Times and weights from one time to another.
template <int Dim>
class ViscousHistory<Dim>::Way {
 public:
  /// At 0, since the end lies before all states that were kept: these are forgotten.
  bool begins_anew() const { return begins_anew_; }

 private:
  friend class ViscousHistory;
  struct Point {
    double t;
    functions::PlacedProgram::Instant instant;
  };
  double to_time = 0;
  size_t from = 0, to = 0;  ///< states; the same: there is nothing to go
  bool is_kept = true;      ///< the end of the way, in states_[to]
  bool begins_anew_ = false;
  std::vector<ExponentialGauss> rules;  ///< [clock], of one interval; all have the same points
  std::vector<Point> points;            ///< [interval * n_points + point]
};

extern template class ViscousHistory<2>;
extern template class ViscousHistory<3>;

}  // namespace diptych::exact
