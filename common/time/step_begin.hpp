#pragma once
/// The state at the beginning of a step, to go back to where the step has failed
/// (body_solver.hpp, notes 5.6): unknowns, audit, boundary, clock. Nearly free where no step fails:
///   - Runge-Kutta steps keep v_0, u_0, F_0, H_0, J_0 anyway; only the internal variables, which
///     the last stage overwrites, are copied in every step.
///   - Leapfrog keeps nothing and a copy would cost a tenth of it: every `period` steps all that a
///     step begins with is copied, and what lies between is stepped again. A step is a function of
///     that, so that it comes back to the last bit.
/// Test: tests/common/run/rejection_test.cpp

#include "common/scheme/ranks/untouched.hpp"
#include "common/time/moving_body.hpp"

#include <vector>

namespace diptych::time {

template <int Dim>
class StepBegin {
 public:
  explicit StepBegin(const MovingBody<Dim>& moving);

  /// To be told before each step that is not a second attempt.
  void keep(MovingBody<Dim>& moving, double t_limit);
  /// Puts the body back to where the last keep() saw it.
  void restore(MovingBody<Dim>& moving);
  /// The step to make, and those after it until they have grown again, are no larger than dt [s].
  /// @pre the body has just been put back
  void shorten(MovingBody<Dim>& moving, double dt);
  /// What has been kept is of no use any more: something else than steps has changed the body.
  void forget() { is_kept_ = false; }
  std::int64_t bytes() const;
  /// Gives back what it keeps of these blocks (scheme/ranks/untouched.hpp).
  void release(const scheme::Blocks& untouched);

  /// Steps of leapfrog between copies: the cost of a copy falls, what a rejection costs rises.
  static constexpr std::int64_t period = 100;

 private:
  /// Components of an unknown and where they are kept.
  struct Place {
    algebra::NodeTable scheme::Body<Dim>::*table = nullptr;   ///< of the unknown: here
    algebra::BlockField scheme::Body<Dim>::*block = nullptr;  ///< or here
    int first = 0, n = 0;
    algebra::BlockField scheme::Body<Dim>::*kept = nullptr;  ///< by the step itself
    int own = -1;                                            ///< or in own_
    int first_kept = 0;
  };

  void list_places(const MovingBody<Dim>& moving);
  void copy(scheme::Body<Dim>& body);
  void put_back(scheme::Body<Dim>& body);
  template <class Use>
  void for_both(const Place& place, scheme::Body<Dim>& body, const Use& use);

  bool is_leapfrog_;
  bool is_kept_ = false;
  std::vector<Place> places_;
  std::vector<algebra::BlockField> own_;
  // what else a step begins with
  scheme::Audit audit_;
  scheme::Interventions interventions_;
  scheme::LoadRates load_rates_;
  Clock clock_;
  scheme::BoundaryState boundary_;
  scheme::SweepResults results_;
  std::vector<double> limits_;  ///< s, of the steps since the copy, of the one to make too
};

/// The largest step of the steps after a rejection grows by this factor from each to the next: what
/// made a step fail lasts for some steps, and a step as large as the failed one at once would fail
/// again, at the cost of a step each time.
inline constexpr double growth_after_rejection = 1.2;

/// One attempt at a step of the integrator of the body; where the state that it ends in is sound,
/// the clock goes on. @return its size  [s]
/// @throws base::BreakdownError where the step has collapsed, the body as it was
template <int Dim>
double attempt_step(MovingBody<Dim>& moving, double t_limit);

/// Whether all nodes are sound after the last stage or step: J > 0, internal variables positive
/// definite, values finite.
template <int Dim>
bool is_sound(const MovingBody<Dim>& moving) {
  return moving.sweeps.least_J() > 0;
}

extern template class StepBegin<2>;
extern template class StepBegin<3>;

}  // namespace diptych::time
