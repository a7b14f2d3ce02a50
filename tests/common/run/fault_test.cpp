/// A fault in the memory of a run, at any node, in any field, between steps or between the forces
/// and the update of any stage, is found in the step that reads it and told with its node. One that
/// no step reads, since it is overwritten before, changes no bit of what follows.

#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/run/body_solver.hpp"
#include "tests/common/scheme/scenes.hpp"
#include "tests/trials.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace diptych::run {
namespace {

using algebra::Vec3;
using Moving = time::MovingBody<3>;

struct FaultSetting {
  const char* method;
  const char* integrator;
  const char* unknowns;
  bool is_viscoelastic;
};

constexpr int n_steps = 4;

/// Where a value changes: between steps, or before the n-th update of a step (from 0).
struct Instant {
  int step = 0, stage = -1;
};

/// What is put where.
struct InjectedFault {
  Instant instant;
  size_t field = 0;
  int component = 0;
  std::int64_t node = 0;
  double value = 0;
};

class FaultyRun {
 public:
  explicit FaultyRun(const FaultSetting& setting)
      : scene_(tests::scene_of(
            setting.method,
            setting.is_viscoelastic ? tests::spinning_cube : tests::elastic(tests::spinning_cube),
            {std::string("time.integrator=") + setting.integrator,
             std::string("scheme.unknowns=") + setting.unknowns, "time.max_retries=0",
             "scheme.volumes=nodes"})),
        solver_(dynamic_cast<BodySolver<3>&>(*scene_.solver)),
        order_(tests::natural_order(scene_.graph)) {
    // a force of nothing that sees every stage
    moving().boundary = scheme::AppliedBoundary(
        scene_.graph, {},
        [this](const Vec3& X, double) {
          if (X == scene_.graph.X.front() && stage_++ == fault_.instant.stage && is_due()) put();
          return Vec3(Vec3::Zero());
        },
        true);
  }
  FaultyRun(const FaultyRun&) = delete;
  FaultyRun& operator=(const FaultyRun&) = delete;

  Moving& moving() { return solver_.moving(); }
  const std::vector<scheme::Field<3>>& fields() { return moving().body.fields(); }
  int n_stages() const { return solver_.evaluations_per_step(); }
  std::string hash() const { return solver_.state_hash(order_); }

  /// @throws base::BreakdownError
  void make_step(int step, const InjectedFault& fault) {
    fault_ = fault;
    step_ = step;
    stage_ = 0;
    if (fault.instant.stage < 0 && is_due()) put();
    solver_.step(1);
  }

 private:
  bool is_due() const { return fault_.instant.step == step_; }
  void put() {
    const scheme::Field<3>& field = fields()[fault_.field];
    scheme::Body<3>& body = moving().body;
    if (field.table != nullptr) {
      (body.*field.table).set(fault_.node, field.first + fault_.component, fault_.value);
    } else {
      (body.*field.block).set(fault_.node, field.first + fault_.component, fault_.value);
    }
  }

  tests::Scene scene_;
  BodySolver<3>& solver_;
  std::vector<std::int32_t> order_;
  InjectedFault fault_;
  int step_ = 0, stage_ = 0;
};

class FaultInMemory : public testing::TestWithParam<FaultSetting> {};

/// A value that no field may have: not a number, infinite, J < 0 or an internal variable that is
/// not positive definite.
double impossible_value(const scheme::Field<3>& field, std::mt19937_64& random) {
  const bool has_limit = field.role == scheme::Role::unknown &&
                         (field.name == "J" || field.name == "A" || field.name == "S");
  switch (random() % (has_limit ? 3 : 2)) {
    case 0:
      return std::nan("");
    case 1:
      return std::numeric_limits<double>::infinity();
    default:  // J - 1; components of A - I: below 0 on the diagonal, beyond it elsewhere
      return field.name == "J" ? -1.5 : 40.0 * (random() % 2 == 0 ? 1 : -1);
  }
}

/// Whether this value in this field is still possible: a component on the diagonal may be large.
bool is_possible(const scheme::Field<3>& field, int component, double value) {
  const bool is_on_diagonal = component % 6 < 3;
  return (field.name == "A" || field.name == "S") && std::isfinite(value) && is_on_diagonal &&
         value > 0;
}

TEST_P(FaultInMemory, IsFoundInItsStepAtItsNode) {
  parallel::set_threads(1);
  std::mt19937_64 random(7);
  std::vector<std::string> sound;  // hashes after each step
  FaultyRun reference(GetParam());
  for (int step = 0; step < n_steps; ++step) {
    reference.make_step(step, {{-1, -1}, 0, 0, 0, 0});
    sound.push_back(reference.hash());
  }
  const auto n_fields = reference.fields().size();
  tests::Trials trials("faults in memory");
  int n_found = 0;
  for (int trial = 0; trial < trials.n(40, 400); ++trial) {
    FaultyRun run(GetParam());
    InjectedFault fault;
    fault.instant.step = static_cast<int>(random() % (n_steps - 1));
    fault.instant.stage = static_cast<int>(random() % (run.n_stages() + 1)) - 1;
    fault.field = random() % n_fields;
    const scheme::Field<3>& field = run.fields()[fault.field];
    if (field.name == "rate") continue;  // of a sum that is made anew
    fault.component = static_cast<int>(random() % field.n_components);
    fault.node = static_cast<std::int64_t>(random() % run.moving().body.n_owned);
    fault.value = impossible_value(field, random);
    if (is_possible(field, fault.component, fault.value)) fault.value = -fault.value;
    const std::string told = std::string(field.name) + "[" + std::to_string(fault.component) +
                             "] = " + std::to_string(fault.value) + " at node " +
                             std::to_string(fault.node) + ", step " +
                             std::to_string(fault.instant.step) + ", stage " +
                             std::to_string(fault.instant.stage);
    int step = 0;
    bool is_sound = true;
    try {
      for (; step < n_steps; ++step) {
        run.make_step(step, fault);
        // what comes behind the last sweep of a step waits for the first of the next
        if (step > fault.instant.step && run.hash() != sound[step]) break;
      }
      is_sound = step == n_steps;
      EXPECT_TRUE(is_sound) << told << ": step " << step << " went on with another state";
    } catch (const base::BreakdownError& error) {
      ++n_found;
      EXPECT_LE(step, fault.instant.step + 1) << told;
      is_sound = error.node() == fault.node;
      EXPECT_EQ(error.node().value_or(-1), fault.node) << told << "\n" << error.what();
    }
    trials.add(is_sound);
  }
  EXPECT_GT(n_found, trials.n_made() / 3) << "most faults are read by some step";
}

INSTANTIATE_TEST_SUITE_P(All,
                         FaultInMemory,
                         testing::Values(FaultSetting{"sph", "ssp-rk3", "FHJ", true},
                                         FaultSetting{"fvm", "ssp-rk3", "FHJ", true},
                                         FaultSetting{"fvm", "leapfrog", "FHJ", true},
                                         FaultSetting{"sph", "leapfrog", "FJ", false},
                                         FaultSetting{"fvm", "ssp-rk2", "F", true},
                                         FaultSetting{"sph", "ssp-rk3", "F", false}),
                         [](const auto& one) {
                           std::string name = std::string(one.param.method) + one.param.integrator +
                                              one.param.unknowns +
                                              (one.param.is_viscoelastic ? "Branches" : "Elastic");
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace diptych::run
