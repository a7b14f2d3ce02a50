#pragma once
/// A solver whose body is divided among ranks. Rank 0 has the simulation, its observers, guards and
/// files, which see one solver; whatever they ask it for is asked of the other ranks first, which
/// do nothing but follow. So all decisions are made once, and nobody waits for a call that others
/// do not make. Test: tests/ranks

#include "common/run/solver.hpp"

namespace diptych::run {

/// What the ranks did besides.
struct RankCosts {
  double imbalance = 1;  ///< largest work of a rank over the mean, as the partition sees it
  double communication_seconds = 0;  ///< in steps, mean of the ranks, waiting included
  std::int64_t parcel_bytes = 0;     ///< sent in steps, of all ranks
};

/// Of the rank that has most.
struct RankMemory {
  std::int64_t settled = 0;  ///< bytes, resident once what is free has gone back
  std::int64_t peak = 0;     ///< bytes, the largest that was resident
};

class LeadingSolver : public Solver {
 public:
  /// On rank 0; the others call follow().
  /// @param graph    of the solver; it stays as it is
  /// @param surveys  makes those of this rank, while the others make theirs; may be empty
  LeadingSolver(std::unique_ptr<Solver> solver,
                scheme::PairGraph& graph,
                parallel::Communicator& ranks,
                const std::string& partition,
                const MakeSurveys& surveys = {});
  /// The others stop following.
  ~LeadingSolver() override;
  LeadingSolver(const LeadingSolver&) = delete;
  LeadingSolver& operator=(const LeadingSolver&) = delete;

  RankCosts costs() const;
  RankMemory memory() const;

  StepReport step(double t_limit) override;
  bool take_back() override;
  void give(parallel::Communicator& ranks, scheme::PairGraph& graph) override;
  void divide(parallel::Communicator& ranks, const std::string& partition) override;
  double imbalance() const override { return solver_->imbalance(); }
  double time() const override { return solver_->time(); }
  void pass(double t) override;
  bool is_sound() const override { return solver_->is_sound(); }
  scheme::Balance balance() const override;
  const scheme::Audit& audit() const override { return solver_->audit(); }
  const scheme::Interventions& interventions() const override { return solver_->interventions(); }
  void take_snapshot(Snapshot& snapshot) const override;
  Snapshot snapshot(std::span<const std::int32_t> nodes) const override;
  const parallel::Part& part() const override { return solver_->part(); }
  /// Of this rank alone, as the part is: surveys make use of them, on all ranks.
  void visit_own(const Visit& visit) const override { solver_->visit_own(visit); }
  NodeReads reads(std::vector<std::int32_t> nodes) const override {
    return solver_->reads(std::move(nodes));
  }
  Motion motion(NodeReads& reads) const override { return solver_->motion(reads); }
  Survey& survey(size_t survey) const override { return solver_->survey(survey); }
  Answers ask(size_t survey, std::span<const double> question) const override;
  algebra::Vec3 reaction(const std::vector<std::int32_t>& nodes) override;
  std::string state_hash(const std::vector<std::int32_t>& order) const override;
  void archive(algebra::Archive& archive) override;
  int unknowns_per_node() const override { return solver_->unknowns_per_node(); }
  std::string arrangement() const override { return solver_->arrangement(); }
  int evaluations_per_step() const override { return solver_->evaluations_per_step(); }
  std::int64_t bytes() const override { return solver_->bytes(); }
  double undeformed_speed() const override { return solver_->undeformed_speed(); }
  double undeformed_step() const override { return solver_->undeformed_step(); }
  const std::vector<algebra::Vec3>& telling_places() const override {
    return solver_->telling_places();
  }
  Mat3 equilibrium_stress(const Mat3& F) const override { return solver_->equilibrium_stress(F); }
  std::optional<Snapshot> exact_state(double t) const override;

 private:
  std::unique_ptr<Solver> solver_;
  parallel::Communicator& ranks_;
  parallel::CommunicationCost spent_;  ///< in steps
};

/// On the other ranks: is given the solver that rank 0 makes a LeadingSolver of, and does what that
/// is asked for until it is gone. What goes wrong in being given it ends all ranks.
/// @param setup, partition  those of rank 0
/// @param surveys           makes those of this rank
void follow(const cases::Case& setup,
            parallel::Communicator& ranks,
            const std::string& partition,
            const MakeSurveys& surveys = {});

}  // namespace diptych::run
