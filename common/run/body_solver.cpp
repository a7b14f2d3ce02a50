#include "common/run/body_solver.hpp"

#include "common/base/error.hpp"
#include "common/run/initial_state.hpp"
#include "common/run/lanczos.hpp"
#include "common/run/ranks/divided_archive.hpp"
#include "common/run/ranks/rank_set_up.hpp"
#include "common/run/ranks/sharing_archive.hpp"
#include "common/run/state_hash.hpp"
#include "common/scheme/body/health.hpp"
#include "common/scheme/body/node_chunks.hpp"
#include "common/scheme/budget/balance.hpp"
#include "common/scheme/ranks/division.hpp"
#include "common/scheme/ranks/exchange.hpp"
#include "common/scheme/ranks/share_graph.hpp"
#include "common/time/moving_body_archive.hpp"
#include "common/time/swing.hpp"

#include <fmt/format.h>

namespace diptych::run {

namespace {

/// For the message of a step that has failed for good.
std::string remark_on(int rejected) {
  if (rejected == 0) return "";
  return fmt::format(
      "so it ended after {} {} with half the step each time; time.max_retries allows "
      "more",
      rejected, rejected == 1 ? "retry" : "retries");
}

}  // namespace

template <int Dim>
BodySolver<Dim>::BodySolver(time::MovingBody<Dim> moving,
                            std::shared_ptr<exact::KnownState> known,
                            int max_retries,
                            const BudgetOfStart::Bounds& start)
    : moving_(std::move(moving)),
      known_(std::move(known)),
      begin_(moving_),
      max_retries_(max_retries),
      bounds_of_start_(start) {}

template <int Dim>
void BodySolver<Dim>::begin(const cases::InitialCase& initial, double kappa_f, double start) {
  set_initial_state(initial, kappa_f, moving_.body);
  moving_.boundary.require_in_front_of_walls(moving_.body);
  moving_.boundary.constrain(moving_.body, start);
  moving_.sweeps.strain_rates(moving_.body, {}, nullptr, 0);
  if (!time::is_sound(moving_)) throw scheme::breakdown_error(moving_.body, 0, 0, 0, "");
  if (moving_.integrator.is_leapfrog()) time::begin_leapfrog(moving_);
  begin_budget();
}

/// What the momenta and the budget of the state as it stands are held against.
template <int Dim>
void BodySolver<Dim>::begin_budget() {
  const scheme::Balance begun = balance();
  moving_.initial_angular_momentum = begun.angular_momentum;
  judge_from(begun);
}

/// The next steps, which begin with this.
template <int Dim>
void BodySolver<Dim>::judge_from(const scheme::Balance& begun) {
  begun_.reset();
  if (max_retries_ == 0) return;
  const BudgetOfStart start(begun, bounds_of_start_, moving_.clock.step);
  if (!moving_.integrator.is_leapfrog()) {
    start_ = start;
  } else {
    time::begin_swing(moving_.clock, bounds_of_start_.opening,
                      start.is_at_rest() ? 0 : start.held(begun), moving_.audit.external_work);
  }
}

template <int Dim>
StepReport BodySolver<Dim>::step(double t_limit) {
  time::Clock& clock = moving_.clock;
  release_fields();
  if (max_retries_ > 0) begin_.keep(moving_, t_limit);
  const bool is_judged = start_ && start_->judges(clock.step);
  if (is_judged && !begun_) begun_ = budget();
  for (int rejected = 0;; ++rejected) {
    const double dt = time::attempt_step(moving_, t_limit);
    if (time::is_sound(moving_)) {
      const StepReport report{clock.step, clock.time,           dt, moving_.sweeps.least_J(),
                              rejected,   clock.time >= t_limit};
      if (!is_judged) {
        const double shorter = rejected < max_retries_ ? time::shorter_for_swing(moving_, dt) : 0;
        if (shorter == 0) return report;
        begin_.restore(moving_);
        begin_.shorten(moving_, shorter);
        continue;
      }
      const bool is_last = rejected == max_retries_ || dt / 2 < clock.least_share * clock.first_dt;
      const EnergyBudget ended = budget();
      if (is_last || !start_->opens(*begun_, ended)) {
        begun_ = ended;  // where the next step begins
        return report;
      }
      begin_.restore(moving_);
      begin_.shorten(moving_, dt / 2);
      continue;
    }
    scheme::gather_state(moving_.body);
    has_fields_of_others_ = true;
    const base::BreakdownError error = scheme::breakdown_error(
        moving_.body, clock.step + 1, clock.time + dt, dt, remark_on(rejected));
    if (max_retries_ > 0) begin_.restore(moving_);
    if (rejected == max_retries_) throw error;
    begin_.shorten(moving_, dt / 2);
  }
}

template <int Dim>
void BodySolver<Dim>::pass(double t) {
  moving_.clock.time = t;
  time::book(moving_, moving_.boundary.jump(moving_.body, t));
  moving_.sweeps.strain_rates(moving_.body, {}, nullptr, 0);
  if (moving_.integrator.is_leapfrog()) time::begin_leapfrog(moving_);
  begin_.forget();  // what is of before the jump
  judge_from(balance());
}

template <int Dim>
bool BodySolver<Dim>::take_back() {
  if (max_retries_ == 0) return false;
  begin_.restore(moving_);
  return true;
}

template <int Dim>
void BodySolver<Dim>::give(parallel::Communicator& ranks, scheme::PairGraph& graph) {
  const scheme::Sweeps<Dim>& sweeps = moving_.sweeps;
  RankSetUp set_up{moving_.body.options, sweeps.time_step().cfl, sweeps.geometric_rate()};
  parallel::share(ranks, set_up);
  scheme::share_nodes(ranks, graph, set_up.body.volumes);
  scheme::share_indices(ranks, moving_.body.graph);
}

template <int Dim>
void BodySolver<Dim>::divide(parallel::Communicator& ranks, const std::string& partition) {
  scheme::divide(moving_.body, ranks, partition);
  scheme::share_geometry(moving_.body);
  SharingArchive state(ranks);
  keep_or_take(state);
  moving_.sweeps.remember_forces(moving_.body);
  scheme::share_last_block(moving_.body);
  moving_.boundary.begin_constant_loads(moving_.body, time());
  begin_budget();
  scheme::release_graph(moving_.body);
  moving_.boundary.release(moving_.body.division->untouched.owned);
  has_fields_of_others_ = true;
  release_fields();
}

/// Back to the system with what others have, which steps do not read.
template <int Dim>
void BodySolver<Dim>::release_fields() {
  if (!has_fields_of_others_ || !moving_.body.division) return;
  has_fields_of_others_ = false;
  scheme::release_fields(moving_.body);
  begin_.release(moving_.body.division->untouched.owned);
}

template <int Dim>
double BodySolver<Dim>::imbalance() const {
  return moving_.body.division ? moving_.body.division->imbalance : 1;
}

template <int Dim>
scheme::Balance BodySolver<Dim>::balance() const {
  scheme::Balance balance = scheme::balance(material(), moving_.body);
  if (moving_.integrator.is_leapfrog()) balance.swing = time::swing_of(moving_);
  return balance;
}

template <int Dim>
void BodySolver<Dim>::take_snapshot(Snapshot& snapshot) const {
  has_fields_of_others_ = true;
  scheme::gather(moving_.body, scheme::Role::unknown);
  if (moving_.body.part().rank() != 0) return;
  const scheme::Undivided<Dim> gathered(moving_.body);
  scheme::take_snapshot(material(), moving_.body, time(), snapshot);
}

template <int Dim>
Snapshot BodySolver<Dim>::snapshot(std::span<const std::int32_t> nodes) const {
  return scheme::snapshot_of(material(), moving_.body, time(), nodes);
}

template <int Dim>
void BodySolver<Dim>::visit_own(const Visit& visit) const {
  scheme::visit_chunks(material(), moving_.body, time(), visit);
}

template <int Dim>
NodeReads BodySolver<Dim>::reads(std::vector<std::int32_t> nodes) const {
  NodeReads reads{std::move(nodes), {}};
  const parallel::Part& part = moving_.body.part();
  if (part.is_whole()) return reads;
  std::vector<char> needed(static_cast<size_t>(moving_.body.n_owned), 0);
  for (const std::int32_t a : reads.nodes)
    needed[static_cast<size_t>(a)] = 1;
  reads.halo = parallel::Halo(part.ranks(), needed,
                              [&](std::int64_t a) { return part.owner(scheme::chunk_of_node(a)); });
  return reads;
}

template <int Dim>
Motion BodySolver<Dim>::motion(NodeReads& reads) const {
  const scheme::Body<Dim>& body = moving_.body;
  const bool all = reads.nodes.empty() && body.part().is_whole();
  const auto n = all ? static_cast<size_t>(body.n_owned) : reads.nodes.size();
  Motion motion{std::vector<algebra::Vec3>(n, algebra::Vec3::Zero()),
                std::vector<algebra::Vec3>(n, algebra::Vec3::Zero())};
  lanczos::for_nodes(static_cast<std::int64_t>(n), [&](std::int64_t k) {
    const std::int64_t a = all ? k : reads.nodes[static_cast<size_t>(k)];
    if (!body.part().owns(scheme::chunk_of_node(a))) return;
    for (int i = 0; i < Dim; ++i) {
      motion.u[k][i] = body.u.at(a, i);
      motion.v[k][i] = body.v.at(a, i);
    }
  });
  if (body.part().is_whole()) return motion;
  const auto place_of = [&](std::int64_t a) {
    return std::lower_bound(reads.nodes.begin(), reads.nodes.end(), a) - reads.nodes.begin();
  };
  reads.halo.exchange([&](std::int64_t begin, std::int64_t end, const auto& use) {
    const bool is_own = body.part().owns(scheme::chunk_of_node(begin));
    for (std::int64_t a = begin; a < end; ++a) {
      double values[2 * Dim] = {};
      for (int i = 0; is_own && i < Dim; ++i) {
        values[i] = body.u.at(a, i);
        values[Dim + i] = body.v.at(a, i);
      }
      use(reinterpret_cast<std::byte*>(values), sizeof values);
      if (is_own) continue;
      const auto k = place_of(a);
      for (int i = 0; i < Dim; ++i) {
        motion.u[k][i] = values[i];
        motion.v[k][i] = values[Dim + i];
      }
    }
  });
  return motion;
}

template <int Dim>
algebra::Vec3 BodySolver<Dim>::reaction(const std::vector<std::int32_t>& nodes) {
  if (!moving_.integrator.is_leapfrog()) {  // whose forces are those of the end of the step
    moving_.sweeps.sum_forces(moving_.body, false);
    moving_.boundary.add_loads(moving_.body, time());
  }
  return moving_.boundary.reaction(moving_.body, nodes);
}

template <int Dim>
std::string BodySolver<Dim>::state_hash(const std::vector<std::int32_t>& order) const {
  return run::state_hash(moving_.body, order, time());
}

template <int Dim>
void BodySolver<Dim>::keep_or_take(algebra::Archive& archive) {
  time::archive(moving_, archive);
  if (known_) known_->archive(archive);
  std::vector<double> start = start_ ? start_->numbers() : std::vector<double>();
  archive.reals("start/budget", "J", start);
  if (!archive.is_loading()) return;
  if (!start.empty()) start_ = BudgetOfStart(bounds_of_start_.energies, start);
  begun_.reset();
  begin_ = time::StepBegin<Dim>(moving_);  // which keeps nothing of the steps until then
  if (!time::is_sound(moving_)) {
    throw base::InputError(
        "the state to go on from is not sound: a node has J <= 0 or a value that is not finite");
  }
}

template <int Dim>
void BodySolver<Dim>::archive(algebra::Archive& archive) {
  if (moving_.body.division) {
    if (!archive.is_loading()) moving_.boundary.complete(moving_.body.part());
    DividedArchive divided(moving_.body.part(), archive);
    keep_or_take(divided);
  } else {
    keep_or_take(archive);
  }
  if (archive.is_loading()) moving_.sweeps.remember_forces(moving_.body);
}

template <int Dim>
Mat3 BodySolver<Dim>::equilibrium_stress(const Mat3& F) const {
  const auto X = physics::deformation_of(algebra::to_tensor(F));
  const auto response = material().response(X);
  return algebra::to_eigen(material().has_H() ? physics::piola_stress<true>(response, X)
                                              : physics::piola_stress<false>(response, X));
}

template <int Dim>
std::optional<Snapshot> BodySolver<Dim>::exact_state(double t) const {
  if (!known_) return std::nullopt;
  return known_->snapshot(t);
}

template class BodySolver<2>;
template class BodySolver<3>;

}  // namespace diptych::run
