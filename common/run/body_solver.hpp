#pragma once
/// The solver of a case on a graph: a body, the sweeps of its material, its boundary and a step.

#include "common/exact/manufactured/manufactured_solution.hpp"
#include "common/run/budget_of_start.hpp"
#include "common/run/solver.hpp"
#include "common/time/step_begin.hpp"

namespace diptych::run {

template <int Dim>
class BodySolver : public Solver {
 public:
  /// Of an undeformed body: begin() sets its state, or another rank's comes by divide().
  /// @param known        exact state of a manufactured solution, or null
  /// @param max_retries  of one step
  /// @param start        what the first steps are held to, leapfrog's by the swing of its energy
  ///                     (time/swing.hpp); none where max_retries is 0
  BodySolver(time::MovingBody<Dim> moving,
             std::shared_ptr<exact::KnownState> known,
             int max_retries,
             const BudgetOfStart::Bounds& start);
  /// Puts the body into its initial state.
  /// @param start  of which prescribed velocities are (step_ends.hpp)  [s]
  void begin(const cases::InitialCase& initial, double kappa_f, double start = 0);

  StepReport step(double t_limit) override;
  bool take_back() override;
  void give(parallel::Communicator& ranks, scheme::PairGraph& graph) override;
  void divide(parallel::Communicator& ranks, const std::string& partition) override;
  double imbalance() const override;
  double time() const override { return moving_.clock.time; }
  void pass(double t) override;
  bool is_sound() const override { return time::is_sound(moving_); }
  scheme::Balance balance() const override;
  const scheme::Audit& audit() const override { return moving_.audit; }
  const scheme::Interventions& interventions() const override { return moving_.interventions; }
  void take_snapshot(Snapshot& snapshot) const override;
  Snapshot snapshot(std::span<const std::int32_t> nodes) const override;
  const parallel::Part& part() const override { return moving_.body.part(); }
  void visit_own(const Visit& visit) const override;
  NodeReads reads(std::vector<std::int32_t> nodes) const override;
  Motion motion(NodeReads& reads) const override;
  algebra::Vec3 reaction(const std::vector<std::int32_t>& nodes) override;
  std::string state_hash(const std::vector<std::int32_t>& order) const override;
  void archive(algebra::Archive& archive) override;
  int unknowns_per_node() const override { return moving_.body.unknowns_per_node(); }
  std::string arrangement() const override { return moving_.body.in_runs() ? "runs" : "rows"; }
  double undeformed_speed() const override { return material().undeformed_speed(); }
  double undeformed_step() const override { return moving_.sweeps.undeformed_step(); }
  const std::vector<algebra::Vec3>& telling_places() const override {
    return moving_.boundary.telling_places();
  }
  int evaluations_per_step() const override { return moving_.integrator.evaluations_per_step(); }
  Mat3 equilibrium_stress(const Mat3& F) const override;
  std::optional<Snapshot> exact_state(double t) const override;
  /// What moves, for tests: they put faults into it.
  time::MovingBody<Dim>& moving() { return moving_; }
  std::int64_t bytes() const override {
    return moving_.body.bytes() + moving_.body.graph.bytes() + begin_.bytes();
  }

 private:
  void keep_or_take(algebra::Archive& archive);
  void release_fields();
  void begin_budget();
  void judge_from(const scheme::Balance& begun);
  EnergyBudget budget() const { return {balance(), moving_.audit}; }
  const scheme::MaterialModel& material() const { return moving_.sweeps.material(); }

  mutable time::MovingBody<Dim> moving_;  ///< what other ranks have comes where it is looked at
  std::shared_ptr<exact::KnownState> known_;
  time::StepBegin<Dim> begin_;
  int max_retries_;
  mutable bool has_fields_of_others_ = false;  ///< gathered or loaded, until the next step
  BudgetOfStart::Bounds bounds_of_start_;
  std::optional<BudgetOfStart> start_;
  std::optional<EnergyBudget>
      begun_;  ///< budget of the state that the next judged step begins with
};

extern template class BodySolver<2>;
extern template class BodySolver<3>;

}  // namespace diptych::run
