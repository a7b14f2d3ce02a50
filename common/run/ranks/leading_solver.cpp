#include "common/run/ranks/leading_solver.hpp"

#include "common/base/error.hpp"
#include "common/parallel/agreement.hpp"
#include "common/parallel/pages.hpp"
#include "common/parallel/ranks.hpp"
#include "common/parallel/sharing.hpp"
#include "common/run/ranks/divided_archive.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fmt/format.h>

namespace diptych::run {

namespace {

enum class Task : std::int32_t {
  share,
  step,
  take_back,
  pass,
  balance,
  snapshot,
  snapshot_of_nodes,
  survey,
  reaction,
  state_hash,
  keep,
  load,
  exact_state,
  costs,
  memory,
  end
};

const char* name_of(Task task) {
  constexpr const char* names[] = {"set-up",
                                   "a step",
                                   "taking a step back",
                                   "a jump of loads",
                                   "a balance",
                                   "a snapshot",
                                   "probes",
                                   "a survey",
                                   "a reaction",
                                   "a state hash",
                                   "writing a checkpoint",
                                   "loading a checkpoint",
                                   "an exact state",
                                   "the costs",
                                   "the memory",
                                   "the end"};
  return names[static_cast<int>(task)];
}

/// What rank 0 asks for; nodes or numbers follow where n > 0.
struct Order {
  Task task = Task::end;
  double time = 0;  ///< s
  std::int64_t n = 0;
  size_t number = 0;  ///< of a survey
};

void ask(parallel::Communicator& ranks,
         Task task,
         double time = 0,
         std::int64_t n = 0,
         size_t number = 0) {
  Order given{task, time, n, number};
  parallel::share(ranks, given);
}

/// Ends all ranks with what this one alone has met: the others would wait for it for ever.
[[noreturn]] void fail(parallel::Communicator& ranks, Task task, const char* message) {
  std::fputs(fmt::format("diptych: rank {} of {}, in {}: {}\n", ranks.rank(), ranks.size(),
                         name_of(task), message)
                 .c_str(),
             stderr);
  ranks.abort(static_cast<int>(base::ExitCode::environment));
  std::abort();
}

constexpr const char* out_of_memory = "out of memory; use a smaller --level, or more machines";

/// Calls work(), whose base::Errors are of the state that all ranks have, or agreed on
/// (common/parallel/agreement.hpp).
template <class Work>
auto work_together(parallel::Communicator& ranks, Task task, const Work& work) {
  const parallel::Phase phase(name_of(task));
  try {
    return work();
  } catch (const base::Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail(ranks, task, out_of_memory);
  } catch (const std::exception& error) {
    fail(ranks, task, error.what());
  }
}

/// The same of what gives the other ranks their parts, where nothing is agreed on.
template <class Work>
void share_together(parallel::Communicator& ranks, const Work& work) {
  work_together(ranks, Task::share, [&] {
    try {
      work();
    } catch (const base::Error& error) {
      fail(ranks, Task::share, error.what());
    }
  });
}

/// Adds what is spent in its lifetime: in a step, not in waiting for the next one.
struct Spending {
  Spending(const parallel::Communicator& of, parallel::CommunicationCost& to)
      : ranks(of), spent(to), before(of.cost()) {}
  ~Spending() {
    const parallel::CommunicationCost now = ranks.cost();
    spent.seconds += now.seconds - before.seconds;
    spent.parcel_bytes += now.parcel_bytes - before.parcel_bytes;
  }
  Spending(const Spending&) = delete;
  Spending& operator=(const Spending&) = delete;
  const parallel::Communicator& ranks;
  parallel::CommunicationCost& spent;
  parallel::CommunicationCost before;
};

/// @param spent  by this rank in steps
RankCosts sum_costs(const Solver& solver,
                    parallel::Communicator& ranks,
                    const parallel::CommunicationCost& spent) {
  const auto n = static_cast<size_t>(ranks.size());
  std::vector<parallel::CommunicationCost> all(n);
  all[ranks.rank()] = spent;
  const std::vector<std::int64_t> bytes(n, sizeof(parallel::CommunicationCost));
  ranks.all_gather(parallel::bytes_of(all.data()), bytes);
  RankCosts costs{solver.imbalance()};
  for (const parallel::CommunicationCost& cost : all) {
    costs.communication_seconds += cost.seconds / static_cast<double>(n);
    costs.parcel_bytes += cost.parcel_bytes;
  }
  return costs;
}

RankMemory largest_memory(parallel::Communicator& ranks) {
  const auto n = static_cast<size_t>(ranks.size());
  std::vector<RankMemory> all(n);
  all[ranks.rank()] = {parallel::settled_bytes(), parallel::status_bytes("VmHWM:")};
  const std::vector<std::int64_t> bytes(n, sizeof(RankMemory));
  ranks.all_gather(parallel::bytes_of(all.data()), bytes);
  RankMemory largest;
  for (const RankMemory& memory : all) {
    largest.settled = std::max(largest.settled, memory.settled);
    largest.peak = std::max(largest.peak, memory.peak);
  }
  return largest;
}

template <class T>
std::vector<T> received(parallel::Communicator& ranks, std::int64_t n) {
  std::vector<T> values(static_cast<size_t>(n));
  ranks.broadcast(parallel::bytes_of(values.data()), n * static_cast<std::int64_t>(sizeof(T)));
  return values;
}

/// Of nodes, to the others.
void send_nodes(parallel::Communicator& ranks, Task task, std::span<const std::int32_t> nodes) {
  std::vector<std::int32_t> copy(nodes.begin(), nodes.end());
  ask(ranks, task, 0, std::ssize(copy));
  ranks.broadcast(parallel::bytes_of(copy.data()),
                  std::ssize(copy) * static_cast<std::int64_t>(sizeof(std::int32_t)));
}

/// Of all ranks, on all of them; errors that one of them meets are met by all.
Answers answers_of(const Solver& solver,
                   parallel::Communicator& ranks,
                   size_t survey,
                   std::span<const double> question) {
  std::vector<double> own;
  parallel::agree_on(ranks, [&] { own = solver.survey(survey).answer(solver, question); });
  const auto n = static_cast<size_t>(ranks.size());
  std::vector<std::int64_t> bytes(n, sizeof(std::int64_t)), lengths(n);
  lengths[ranks.rank()] = std::ssize(own);
  ranks.all_gather(parallel::bytes_of(lengths.data()), bytes);
  std::int64_t all_of = 0, before = 0;
  for (size_t r = 0; r < n; ++r) {
    if (r == static_cast<size_t>(ranks.rank())) before = all_of;
    bytes[r] = lengths[r] * static_cast<std::int64_t>(sizeof(double));
    all_of += lengths[r];
  }
  std::vector<double> all(static_cast<size_t>(all_of));
  std::copy(own.begin(), own.end(), all.begin() + before);
  ranks.all_gather(parallel::bytes_of(all.data()), bytes);
  Answers answers;
  auto next = all.begin();
  for (const std::int64_t length : lengths) {
    answers.emplace_back(next, next + length);
    next += length;
  }
  return answers;
}

void carry_out(const Order& order,
               Solver& solver,
               parallel::Communicator& ranks,
               parallel::CommunicationCost& spent) {
  switch (order.task) {
    case Task::share:
      break;  // is over
    case Task::step: {
      const Spending spending(ranks, spent);
      solver.step(order.time);
      break;
    }
    case Task::take_back:
      (void)solver.take_back();
      break;
    case Task::pass:
      solver.pass(order.time);
      break;
    case Task::balance:
      (void)solver.balance();
      break;
    case Task::snapshot:
      (void)solver.snapshot();
      break;
    case Task::snapshot_of_nodes:
      (void)solver.snapshot(received<std::int32_t>(ranks, order.n));
      break;
    case Task::survey: {
      std::vector<double> question = received<double>(ranks, order.n);
      (void)answers_of(solver, ranks, order.number, question);
      break;
    }
    case Task::reaction:
      solver.reaction(received<std::int32_t>(ranks, order.n));
      break;
    case Task::state_hash:
      (void)solver.state_hash({});
      break;
    case Task::keep:
    case Task::load: {
      NoArchive none(order.task == Task::load);
      solver.archive(none);
      break;
    }
    case Task::exact_state:
      (void)solver.exact_state(order.time);
      break;
    case Task::costs:
      (void)sum_costs(solver, ranks, spent);
      break;
    case Task::memory:
      (void)largest_memory(ranks);
      break;
    case Task::end:
      break;
  }
}

}  // namespace

LeadingSolver::LeadingSolver(std::unique_ptr<Solver> solver,
                             scheme::PairGraph& graph,
                             parallel::Communicator& ranks,
                             const std::string& partition,
                             const MakeSurveys& surveys)
    : solver_(std::move(solver)), ranks_(ranks) {
  share_together(ranks, [&] {
    solver_->give(ranks, graph);
    solver_->divide(ranks, partition);
    if (surveys) solver_->take(surveys(*solver_));
  });
}

LeadingSolver::~LeadingSolver() {
  run::ask(ranks_, Task::end);
}

RankCosts LeadingSolver::costs() const {
  run::ask(ranks_, Task::costs);
  return sum_costs(*solver_, ranks_, spent_);
}

RankMemory LeadingSolver::memory() const {
  run::ask(ranks_, Task::memory);
  return largest_memory(ranks_);
}

StepReport LeadingSolver::step(double t_limit) {
  run::ask(ranks_, Task::step, t_limit);
  const Spending spending(ranks_, spent_);
  return work_together(ranks_, Task::step, [&] { return solver_->step(t_limit); });
}

bool LeadingSolver::take_back() {
  run::ask(ranks_, Task::take_back);
  return work_together(ranks_, Task::take_back, [&] { return solver_->take_back(); });
}

void LeadingSolver::pass(double t) {
  run::ask(ranks_, Task::pass, t);
  work_together(ranks_, Task::pass, [&] { solver_->pass(t); });
}

void LeadingSolver::give(parallel::Communicator&, scheme::PairGraph&) {}

void LeadingSolver::divide(parallel::Communicator&, const std::string&) {}

scheme::Balance LeadingSolver::balance() const {
  run::ask(ranks_, Task::balance);
  return work_together(ranks_, Task::balance, [&] { return solver_->balance(); });
}

void LeadingSolver::take_snapshot(Snapshot& snapshot) const {
  run::ask(ranks_, Task::snapshot);
  work_together(ranks_, Task::snapshot, [&] { solver_->take_snapshot(snapshot); });
}

Snapshot LeadingSolver::snapshot(std::span<const std::int32_t> nodes) const {
  send_nodes(ranks_, Task::snapshot_of_nodes, nodes);
  return work_together(ranks_, Task::snapshot_of_nodes, [&] { return solver_->snapshot(nodes); });
}

Answers LeadingSolver::ask(size_t survey, std::span<const double> question) const {
  run::ask(ranks_, Task::survey, 0, std::ssize(question), survey);
  std::vector<double> copy(question.begin(), question.end());
  ranks_.broadcast(parallel::bytes_of(copy.data()),
                   std::ssize(copy) * static_cast<std::int64_t>(sizeof(double)));
  return work_together(ranks_, Task::survey,
                       [&] { return answers_of(*solver_, ranks_, survey, question); });
}

algebra::Vec3 LeadingSolver::reaction(const std::vector<std::int32_t>& nodes) {
  send_nodes(ranks_, Task::reaction, nodes);
  return work_together(ranks_, Task::reaction, [&] { return solver_->reaction(nodes); });
}

std::string LeadingSolver::state_hash(const std::vector<std::int32_t>& order) const {
  run::ask(ranks_, Task::state_hash);
  return work_together(ranks_, Task::state_hash, [&] { return solver_->state_hash(order); });
}

void LeadingSolver::archive(algebra::Archive& archive) {
  const Task task = archive.is_loading() ? Task::load : Task::keep;
  run::ask(ranks_, task);
  work_together(ranks_, task, [&] { solver_->archive(archive); });
}

std::optional<Snapshot> LeadingSolver::exact_state(double t) const {
  run::ask(ranks_, Task::exact_state, t);
  return work_together(ranks_, Task::exact_state, [&] { return solver_->exact_state(t); });
}

void follow(const cases::Case& setup,
            parallel::Communicator& ranks,
            const std::string& partition,
            const MakeSurveys& surveys) {
  std::vector<scheme::BoundaryPatch> patches;  // which the solver refers to
  std::unique_ptr<Solver> solver;
  share_together(ranks, [&] {
    scheme::PairGraph nodes;
    solver = make_given_solver(setup, nodes, ranks);
    patches = std::move(nodes.patches);
    nodes = {};
    solver->divide(ranks, partition);
    if (surveys) solver->take(surveys(*solver));
  });
  parallel::CommunicationCost spent;
  for (;;) {
    Order order;
    parallel::share(ranks, order);
    if (order.task == Task::end) return;
    try {
      work_together(ranks, order.task, [&] { carry_out(order, *solver, ranks, spent); });
    } catch (const base::Error&) {
      // of the state, which all ranks have: rank 0 says it, and goes on with what it asks next
    }
  }
}

}  // namespace diptych::run
