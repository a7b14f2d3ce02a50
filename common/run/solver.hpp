#pragma once
/// A body in motion: case and pair graph in, steps out. Type erasure stands here, once per step;
/// the compiled models behind it are in the menu of model_menu.cpp.

#include "common/algebra/archive.hpp"
#include "common/cases/case.hpp"
#include "common/parallel/communicator.hpp"
#include "common/parallel/halo.hpp"
#include "common/run/survey.hpp"
#include "common/scheme/body/snapshot.hpp"
#include "common/scheme/budget/audit.hpp"
#include "common/scheme/budget/interventions.hpp"
#include "common/scheme/graph/pair_graph.hpp"
#include "common/scheme/volumes/bulk_volumes.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych::run {

using algebra::Mat3;
using scheme::Snapshot;

/// What one step did.
struct StepReport {
  std::int64_t step = 0;  ///< number of the step, from 1
  double time = 0;        ///< s, at its end
  double dt = 0;          ///< s
  double least_J = 1;
  int rejected = 0;          ///< attempts at it before, with larger steps
  bool is_at_limit = false;  ///< it ends at an instant of output, or before a jump of the loads
};

/// Of some nodes.
struct Motion {
  std::vector<algebra::Vec3> u, v;  ///< m, m/s
};

/// Nodes whose motion a rank reads, its own and those of others.
struct NodeReads {
  std::vector<std::int32_t> nodes;  ///< ascending; empty: all, of a body that is not divided
  parallel::Halo halo;
};

class Solver {
 public:
  virtual ~Solver() = default;
  /// Makes one step, not beyond t_limit; time left is divided into equal steps where it is less
  /// than a few. A step that ends with J <= 0 or a value that is not finite is tried again from its
  /// beginning with half its size. @throws base::BreakdownError where that has failed
  /// time.max_retries times, or dt has collapsed. The body then is as it was before the step, but
  /// with no retries as it has ended up
  virtual StepReport step(double t_limit) = 0;
  /// Puts the body back to where it was before the last step, to its last bits; nothing else may
  /// have changed it since. @return false, with nothing done, where it keeps no such state
  /// (time.max_retries = 0)
  virtual bool take_back() = 0;
  virtual double time() const = 0;
  /// Goes on from an instant just before a jump of the loads to t, just after it: the next step
  /// sees but what is behind it, and the next steps are judged as the first ones are.
  /// @pre a step has ended there
  virtual void pass(double t) = 0;
  /// Of rank 0: gives other ranks what their make_given_solver() asks for.
  /// @param graph  of this solver; it stays as it is
  virtual void give(parallel::Communicator& ranks, scheme::PairGraph& graph) = 0;
  /// Shares the body, and the state that it has on rank 0, with other ranks, which have been given
  /// a solver: each works its part from now on. All ranks then make the same calls of what is not
  /// const, of balance(), take_snapshot(), reads(), motion(), state_hash() and exact_state(); rank
  /// 0 alone has the whole results of balance() to exact_state(), and alone has a file to archive.
  /// @param partition  of parallel::partitioners()
  /// @throws base::InputError where there are too many ranks, on all of them
  virtual void divide(parallel::Communicator& ranks, const std::string& partition) = 0;
  /// Largest work of a rank over the mean.
  virtual double imbalance() const = 0;
  /// Whether all nodes have J > 0, internal variables that are positive definite and finite values.
  virtual bool is_sound() const = 0;
  virtual scheme::Balance balance() const = 0;
  virtual const scheme::Audit& audit() const = 0;
  virtual const scheme::Interventions& interventions() const = 0;
  /// All fields, in the memory of an earlier snapshot.
  virtual void take_snapshot(Snapshot& snapshot) const = 0;
  Snapshot snapshot() const {
    Snapshot fields;
    take_snapshot(fields);
    return fields;
  }
  /// Fields of these nodes only, in this order.
  virtual Snapshot snapshot(std::span<const std::int32_t> nodes) const = 0;
  /// The part of this rank.
  virtual const parallel::Part& part() const = 0;
  /// Calls visit(chunk, first, fields) for every chunk of nodes of this rank, by all threads, which
  /// must not throw: fields are those of the nodes from `first` on.
  using Visit = std::function<void(std::int64_t chunk, std::int64_t first, const Snapshot& fields)>;
  virtual void visit_own(const Visit& visit) const = 0;
  /// What motion() takes to give the motion of these nodes, of each rank its own.
  virtual NodeReads reads(std::vector<std::int32_t> nodes) const = 0;
  virtual Motion motion(NodeReads& reads) const = 0;
  /// Has them answered by ask(), by their places.
  void take(Surveys surveys) { surveys_ = std::move(surveys); }
  /// Of this rank.
  virtual Survey& survey(size_t survey) const { return *surveys_.at(survey); }
  virtual Answers ask(size_t survey, std::span<const double> question) const {
    return {surveys_.at(survey)->answer(*this, question)};
  }
  /// Force of supports and walls on these nodes (ascending) at the time of the state  [N]
  virtual algebra::Vec3 reaction(const std::vector<std::int32_t>& nodes) = 0;
  /// A fingerprint of the unknowns and the time (state_hash.hpp); `order[a]` is the user's number
  /// of node a, on rank 0.
  virtual std::string state_hash(const std::vector<std::int32_t>& order) const = 0;
  /// Keeps all that later steps read in the archive, or takes it from there: the steps that follow
  /// then have the same bits.
  /// @pre where it is loading: what is in the archive is of the same case on the same graph
  /// @throws base::InputError where it is not
  virtual void archive(algebra::Archive& archive) = 0;
  virtual int unknowns_per_node() const = 0;
  /// Of the sweeps: "runs" or "rows" (scheme/graph/sweep_graph.hpp); they differ in the last bits.
  virtual std::string arrangement() const = 0;
  virtual int evaluations_per_step() const = 0;
  virtual std::int64_t bytes() const = 0;
  /// c_p of the undeformed, virgin body with all branches  [m/s]
  virtual double undeformed_speed() const = 0;
  /// The stable step of the undeformed, virgin body  [s]
  virtual double undeformed_step() const = 0;
  /// Some of the nodes that loads and prescribed velocities act on, spread among them  [m]
  virtual const std::vector<algebra::Vec3>& telling_places() const = 0;
  /// P(F) of the material without its branches  [Pa]
  virtual Mat3 equilibrium_stress(const Mat3& F) const = 0;
  /// The exact fields at time t where the case gives the motion (manufactured solution).
  virtual std::optional<Snapshot> exact_state(double t) const {
    (void)t;
    return std::nullopt;
  }

 protected:
  Surveys surveys_;
};

/// Whether a case has jumps reconstructed with slopes along lines of nodes, where a graph has them.
bool wants_line_slopes(const cases::Case& setup);

/// Whether jumps are reconstructed with the slopes along lines of nodes that the graph has.
/// @throws base::InputError where they are asked for and it has none
bool has_line_slopes(const cases::Case& setup, const scheme::PairGraph& graph);

/// Whether jumps are reconstructed with slopes and their adjoint (sweeps/jump_adjoint.hpp).
bool is_symmetric(const cases::Case& setup);

/// What gradients of cells carry of the shear modulus of a body with these volumes: the part that
/// scheme.cell_shear asks for.  [Pa]
double cell_shear_of(const cases::Case& setup, scheme::Volumes volumes);

/// Stiffness of displacements that F of the nodes does not see (scheme/hourglass), where the graph
/// has edges and the reconstruction is symmetric.  [Pa]
double hourglass_of(const cases::Case& setup, const scheme::PairGraph& graph);

/// What carries the pressure of this case on this graph (scheme.volumes), never "automatic".
/// @pre graph comes from the program's method menu: its lines and cells are left out where "auto"
/// leaves the pressure to nodes
/// @throws base::InputError where the graph lacks the cells or lines that the case asks for
scheme::Volumes volumes_of(const cases::Case& setup, const scheme::PairGraph& graph);

/// @param graph  kept by reference: must outlive the solver
/// @throws base::InputError on a boundary group that the graph lacks, an unknown menu entry
std::unique_ptr<Solver> make_solver(const cases::Case& setup, const scheme::PairGraph& graph);

/// The same. The graph is left without its pairs once the solver has made its own of them, before
/// the state takes its memory: both side by side would take up to three times what a run does.
std::unique_ptr<Solver> make_solver_of_pairs(const cases::Case& setup, scheme::PairGraph& graph);

/// Of another rank than 0: the solver that rank 0 has made and gives, undeformed until divide().
/// @param graph  becomes that of rank 0 without its pairs; its patches must outlive the solver
std::unique_ptr<Solver> make_given_solver(const cases::Case& setup,
                                          scheme::PairGraph& graph,
                                          parallel::Communicator& ranks);

}  // namespace diptych::run
