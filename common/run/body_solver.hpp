#pragma once
/// The solver of one compiled model: the order of operations of a step (notes 5.5).

#include "common/exact/manufactured/manufactured_solution.hpp"
#include "common/run/solver.hpp"
#include "common/run/state_access.hpp"
#include "common/scheme/boundary/applied_boundary.hpp"
#include "common/scheme/budget/angular_momentum.hpp"
#include "common/scheme/budget/balance.hpp"
#include "common/scheme/sweeps/momentum.hpp"
#include "common/scheme/sweeps/strain_rates.hpp"
#include "common/scheme/sweeps/update.hpp"
#include "common/scheme/time_step.hpp"
#include "common/time/integrator.hpp"

namespace diptych::run {

using algebra::Mat3;

/// Everything of a case that the solver needs, resolved; see model_menu.cpp.
struct SolverSetup {
  scheme::DissipationKind dissipation;
  double dissipation_factor = 1;
  double face_correction = 0;  ///< kappa_f
  scheme::Unknowns unknowns = scheme::Unknowns::FHJ;
  time::Integrator integrator;
  scheme::TimeStepRule time_step;
  bool angular_momentum_projection = false;
  bool energy_budget = true;
  cases::InitialCase initial;
  std::shared_ptr<exact::KnownState> known;  ///< exact state of a manufactured solution, or null
};

template <int Dim, class Material>
class BodySolver : public Solver {
 public:
  BodySolver(const scheme::PairGraph& graph,
             scheme::Model<Material> model,
             SolverSetup setup,
             scheme::AppliedBoundary boundary)
      : graph_(graph),
        pairs_(graph),
        model_(std::move(model)),
        setup_(std::move(setup)),
        boundary_(std::move(boundary)),
        momentum_(scheme::momentum_function<Dim>(setup_.dissipation, Material::has_H)),
        strain_rates_(scheme::strain_rate_function<Dim, Material>()),
        state_(graph.n_nodes(),
               static_cast<int>(model_.branches.size()),
               Material::has_H,
               setup_.unknowns,
               setup_.dissipation.impedance == scheme::Impedance::exact,
               setup_.integrator.gauss_relaxation && !model_.branches.empty(),
               pairs_.shape),
        X_centred_(centred(graph)),
        viscous_power_(parallel::n_chunks_of(pairs_.n_blocks)),
        least_J_(viscous_power_.size()),
        numerical_power_(viscous_power_.size()),
        largest_rate_(viscous_power_.size()),
        geometric_rate_(scheme::geometric_rate(graph)),
        undeformed_speed_(scheme::undeformed_speed(model_)) {
    if (setup_.face_correction != 0) state_.allow_face_correction();
    set_initial_state(graph_, setup_.initial, setup_.face_correction, state_);
    boundary_.constrain(state_, model_.rho_R, 0);
    evaluate({}, nullptr, 0);
    check_health(0);
    if (setup_.integrator.is_leapfrog()) {
      sum_forces(true);
      load_rates_ = boundary_.add_loads(state_, 0);
    }
    initial_angular_momentum_ = balance().angular_momentum;
  }

  StepReport step(double t_limit) override {
    const double dt = setup_.integrator.is_leapfrog() ? leapfrog_step(t_limit) : ssp_step(t_limit);
    time_ = t_limit - (time_ + dt) <= 1e-12 * dt ? t_limit : time_ + dt;
    ++step_;
    return {step_, time_, dt, check_health(dt)};
  }

  double time() const override { return time_; }
  scheme::Balance balance() const override {
    return scheme::balance(model_, pairs_, state_, X_centred_);
  }
  const scheme::Audit& audit() const override { return audit_; }
  Snapshot snapshot() const override { return snapshot_of(model_, state_, time_); }
  Snapshot snapshot(std::span<const std::int32_t> nodes) const override {
    return snapshot_of(model_, state_, time_, nodes);
  }
  algebra::Vec3 reaction(const std::vector<std::int32_t>& nodes) override {
    if (!setup_.integrator.is_leapfrog()) {  // whose forces are those of the end of the step
      sum_forces(false);
      boundary_.add_loads(state_, time_);
    }
    return boundary_.reaction(state_, model_.rho_R, nodes);
  }
  std::string state_hash(const std::vector<std::int32_t>& order) const override {
    return hash_of(state_, order, time_);
  }
  int unknowns_per_node() const override { return state_.unknowns_per_node(); }
  std::string arrangement() const override {
    return pairs_.shape.arrangement == algebra::Arrangement::runs ? "runs" : "rows";
  }
  double undeformed_speed() const override { return undeformed_speed_; }
  int evaluations_per_step() const override { return setup_.integrator.evaluations_per_step(); }
  Mat3 equilibrium_stress(const Mat3& F) const override {
    const auto X = physics::deformation_of(algebra::to_tensor(F));
    const auto response = model_.material.response(X);
    return algebra::to_eigen(physics::piola_stress<Material::has_H>(response, X));
  }
  std::optional<Snapshot> exact_state(double t) const override {
    if (!setup_.known) return std::nullopt;
    return setup_.known->snapshot(t);
  }
  std::int64_t bytes() const override { return state_.bytes() + pairs_.bytes(); }

 private:
  using Rule = scheme::Relaxation::Rule;

  template <class Work>
  void for_blocks(const Work& work) {
    parallel::for_chunks(pairs_.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
      work(begin, end);
    });
  }

  /// Strain rates (18b), relaxation (14), stress (9), wave speeds; F, H, J are moved by the stage
  /// before, or drift in between (leapfrog).
  void evaluate(const scheme::Relaxation& relaxation,
                const scheme::StageCombination* stage,
                double drift) {
    const double kappa_f = setup_.face_correction;
    if (kappa_f != 0) {
      for_blocks([&](auto begin, auto end) { face_.gradients(pairs_, state_, begin, end); });
    }
    const scheme::StrainRateSweep<Dim, Material> sweep{
        model_,
        pairs_,
        state_,
        relaxation,
        setup_.dissipation.impedance == scheme::Impedance::exact,
        setup_.energy_budget,
        kappa_f,
        stage,
        drift,
        viscous_power_.data(),
        least_J_.data()};
    parallel::for_chunks(pairs_.n_blocks, [&](auto begin, auto end, auto chunk) {
      strain_rates_(sweep, begin, end, chunk);
    });
    if (kappa_f != 0) {
      for_blocks(
          [&](auto begin, auto end) { face_.stresses(pairs_, state_, kappa_f, begin, end); });
    }
  }

  /// Internal forces (18a) with D_ab; with_step: also the largest stable step of this state.
  void sum_forces(bool with_step) {
    const bool pair_by_pair = setup_.time_step.speeds == scheme::Speeds::exact;
    const scheme::MomentumSweep<Dim> sweep{pairs_,
                                           state_,
                                           model_.rho_R,
                                           setup_.dissipation_factor,
                                           with_step && pair_by_pair,
                                           numerical_power_.data(),
                                           largest_rate_.data()};
    scheme::sum_forces(sweep, momentum_);
    if (with_step && setup_.time_step.speeds == scheme::Speeds::bound) {
      parallel::for_chunks(pairs_.n_blocks, [&](auto begin, auto end, auto chunk) {
        largest_rate_[chunk] =
            geometric_rate_ * scheme::largest_speed(state_, model_.rho_R, begin, end);
      });
    }
    if (with_step) stable_dt_ = setup_.time_step.limit() / rate();
  }

  /// See scheme/time_step.hpp  [1/s]
  double rate() const {
    if (setup_.time_step.speeds == scheme::Speeds::linearised) {
      return geometric_rate_ * undeformed_speed_;
    }
    double rate = 0;
    for (const double r : largest_rate_)
      rate = r >= rate || std::isnan(r) ? r : rate;
    return rate;
  }

  /// The step to make now: stable, and the time left divided evenly.
  double choose_dt(double t_limit) {
    const double left = t_limit - time_;
    const double n = std::ceil(left / stable_dt_ * (1 - 1e-12));
    const double dt = left / std::max(n, 1.0);
    if (step_ == 0) first_dt_ = dt;
    if (!(dt > 1e-7 * first_dt_) || time_ + dt == time_) {
      throw base::BreakdownError(collapse_report(state_, graph_, step_ + 1, time_, dt, first_dt_));
    }
    return dt;
  }

  scheme::Audit rates() const {
    scheme::Audit rate;
    rate.external_work = load_rates_.power;
    rate.impulse = {load_rates_.force, load_rates_.torque};
    rate.numerical_dissipation = parallel::sum_in_order(numerical_power_);
    rate.viscous_dissipation = parallel::sum_in_order(viscous_power_);
    return rate;
  }

  double ssp_step(double t_limit) {
    const scheme::Audit audit_0 = audit_;
    double dt = 0, stage_time = time_, fraction = 0;
    const auto& stages = setup_.integrator.stages;
    for (size_t i = 0; i < stages.size(); ++i) {
      const bool first = i == 0, last = i + 1 == stages.size();
      sum_forces(first);
      if (first) {
        dt = choose_dt(t_limit);
        boundary_.begin_step(time_, dt);
      }
      load_rates_ = boundary_.add_loads(state_, stage_time);
      scheme::Audit rate = rates();
      rate.external_work += boundary_.power_of_constraints(state_, model_.rho_R, fraction);
      const scheme::StageCombination stage{stages[i].alpha, stages[i].beta, stages[i].part * dt,
                                           first};
      audit_ = audit_.combined(stage.alpha, audit_0, stage.beta, stage.dt, rate);
      for_blocks([&](auto begin, auto end) {
        scheme::update_motion(state_, pairs_, model_.rho_R, stage, begin, end);
      });
      stage_time = time_ + stages[i].time * dt;
      add_action(last ? boundary_.constrain(state_, model_.rho_R, stage_time)
                      : boundary_.constrain_stage(state_, model_.rho_R, stage.alpha, stage.beta,
                                                  stage.dt, fraction));
      if (last) keep_angular_momentum();
      fraction = stages[i].time;
      const Rule rule = model_.branches.empty()                      ? Rule::frozen
                        : last && setup_.integrator.gauss_relaxation ? Rule::gauss
                                                                     : Rule::linear;
      evaluate({rule, last, stages[i].time * dt, model_.branches}, &stage, 0);
    }
    return dt;
  }

  double leapfrog_step(double t_limit) {
    const double dt = choose_dt(t_limit);
    boundary_.begin_step(time_, dt);
    scheme::Audit rate;
    kick(dt / 2, !model_.branches.empty());
    rate.impulse = {0.5 * load_rates_.force, 0.5 * load_rates_.torque};
    constrain(time_ + dt / 2);
    rate.external_work = 0.5 * boundary_.power_of_loads(state_);
    rate.external_work += 0.5 * boundary_.power_of_constraints(state_, model_.rho_R, 0.5);
    const Rule rule = model_.branches.empty() ? Rule::frozen : Rule::linear;
    rate.viscous_dissipation = 0.5 * parallel::sum_in_order(viscous_power_);
    evaluate({rule, true, dt, model_.branches}, nullptr, dt);
    rate.viscous_dissipation += 0.5 * parallel::sum_in_order(viscous_power_);
    sum_forces(true);
    load_rates_ = boundary_.add_loads(state_, time_ + dt);
    rate.external_work += 0.5 * load_rates_.power;
    // the same velocities against the forces of the end: the trapezoid, of second order
    rate.external_work += 0.5 * boundary_.power_of_constraints(state_, model_.rho_R, 0.5);
    rate.impulse.linear += 0.5 * load_rates_.force;
    rate.impulse.angular += 0.5 * load_rates_.torque;
    rate.numerical_dissipation = parallel::sum_in_order(numerical_power_);
    kick(dt / 2, false);
    constrain(time_ + dt);
    audit_ = audit_.combined(0, audit_, 1, dt, rate);
    keep_angular_momentum();
    return dt;
  }

  /// Gives back the angular momentum that D_ab and the integrator took, before the strain rates see
  /// the velocities: F stays the gradient of x. What this changes in the kinetic energy is booked
  /// with the dissipation that made it necessary.
  void keep_angular_momentum() {
    if (!setup_.angular_momentum_projection) return;
    audit_.numerical_dissipation -=
        project_angular_momentum(state_, pairs_, X_centred_, model_.rho_R,
                                 initial_angular_momentum_ + audit_.impulse.angular);
  }

  void kick(double dt, bool keep_F) {
    for_blocks([&](auto begin, auto end) {
      scheme::kick(state_, pairs_, model_.rho_R, dt, keep_F, begin, end);
    });
  }

  /// Prescribed velocities at time t.
  void constrain(double t) { add_action(boundary_.constrain(state_, model_.rho_R, t)); }
  void add_action(const scheme::ConstraintAction& action) {
    audit_.impulse.linear += action.impulse.linear;
    audit_.impulse.angular += action.impulse.angular;
    audit_.external_work += action.work;
  }

  /// @return least J  @throws base::BreakdownError with the first bad node
  double check_health(double dt) const {
    double least = 1e300;
    for (const double J : least_J_) {
      if (!(J > 0)) {
        throw base::BreakdownError(
            breakdown_report(snapshot_of(model_, state_, time_), graph_, step_, dt));
      }
      least = std::min(least, J);
    }
    return least;
  }

  const scheme::PairGraph& graph_;
  scheme::SweepGraph<Dim> pairs_;
  scheme::Model<Material> model_;
  SolverSetup setup_;
  scheme::AppliedBoundary boundary_;
  scheme::MomentumFunction<Dim> momentum_;
  scheme::StrainRateFunction<Dim, Material> strain_rates_;
  scheme::FaceCorrectionSweeps<Dim> face_ = scheme::face_correction_sweeps<Dim>();
  scheme::State<Dim> state_;
  std::vector<algebra::Vec3> X_centred_;
  // results of the sweeps, one per chunk
  std::vector<double> viscous_power_, least_J_, numerical_power_, largest_rate_;
  scheme::LoadRates load_rates_;
  scheme::Audit audit_;
  algebra::Vec3 initial_angular_momentum_ = algebra::Vec3::Zero();
  double geometric_rate_, undeformed_speed_;
  double time_ = 0, stable_dt_ = 0, first_dt_ = 0;
  std::int64_t step_ = 0;
};

}  // namespace diptych::run
