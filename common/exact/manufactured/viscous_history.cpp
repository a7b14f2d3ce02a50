#include "common/exact/manufactured/viscous_history.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

namespace diptych::exact {

namespace {

constexpr double accuracy_wanted = 1e-13;  // of A and of its gradient, relative to their size

/// Largest entry, over value (n = 0) or gradients.
template <int Dim>
double largest(const algebra::SymmetricTensor<algebra::Dual<Lanes, Dim>>& A, bool gradient) {
  double most = 0;
  for (const auto& component : A.s) {
    for (int k = gradient ? 0 : -1; k < (gradient ? Dim : 0); ++k) {
      const Lanes& value = k < 0 ? component.v : component.d[k];
      for (int lane = 0; lane < algebra::n_lanes; ++lane)
        most = std::max(most, std::abs(value[lane]));
    }
  }
  return most;
}

template <int Dim>
struct Drives {
  algebra::SymmetricTensor<algebra::Dual<Lanes, Dim>> inverse_C, inverse_G;
};

/// C^-1 and G^-1 of a block.
DIPTYCH_INLINE Drives<3> drives_of(const algebra::Tensor<algebra::Dual<Lanes, 3>>& F) {
  const auto X = physics::right_tensors(F);
  return {X.inverse_C, X.inverse_G};
}
/// In plane strain, where C_33 = 1 and G_33 = det C: a third of the operations.
DIPTYCH_INLINE Drives<2> drives_of(const algebra::Tensor<algebra::Dual<Lanes, 2>>& F) {
  using Scalar = algebra::Dual<Lanes, 2>;
  const Scalar C_00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0);
  const Scalar C_11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1);
  const Scalar C_01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1);
  const Scalar inverse_det = 1.0 / (C_00 * C_11 - C_01 * C_01);
  auto r = Drives<2>{algebra::symmetric_identity<Scalar>(), algebra::symmetric_identity<Scalar>()};
  r.inverse_G(0, 0) = r.inverse_C(1, 1) = inverse_det * C_00;
  r.inverse_G(1, 1) = r.inverse_C(0, 0) = inverse_det * C_11;
  r.inverse_G(0, 1) = inverse_det * C_01;
  r.inverse_C(0, 1) = -1.0 * r.inverse_G(0, 1);
  r.inverse_G(2, 2) = inverse_det;
  return r;
}

}  // namespace

/// Times and weights of the way from one time to another.
template <int Dim>
struct ViscousHistory<Dim>::Plan {
  struct Point {
    double t;
    functions::PlacedProgram::Instant instant;
  };
  int n_intervals = 0;
  std::vector<ExponentialGauss> rule;       ///< [clock]
  std::vector<std::vector<Point>> at_time;  ///< [clock][interval * n_points + point]
};

template <int Dim>
ViscousHistory<Dim>::ViscousHistory(const Motion& motion,
                                    std::span<const Vec3> X,
                                    std::vector<physics::MaxwellBranch> branches,
                                    bool relaxed,
                                    double end)
    : motion_(&motion),
      placed_(motion.program(), motion.gradients(), X),
      branches_(std::move(branches)),
      relaxed_(relaxed) {
  const auto clock = [&](double tau) -> Clock& {
    for (Clock& c : clocks_) {
      if (c.tau == tau) return c;
    }
    return clocks_.emplace_back(Clock{tau, {}, {}});
  };
  for (int k = 0; k < static_cast<int>(branches_.size()); ++k) {
    if (branches_[k].xi > 0) clock(branches_[k].tau_C).C.push_back(k);
    if (branches_[k].zeta > 0) clock(branches_[k].tau_G).G.push_back(k);
  }
  if (!clocks_.empty()) calibrate(end, X);
  restart();
}

template <int Dim>
ViscousHistory<Dim>::ViscousHistory(const ViscousHistory& other,
                                    std::span<const Vec3> X,
                                    Accuracy accuracy)
    : motion_(other.motion_),
      placed_(motion_->program(), motion_->gradients(), X),
      branches_(other.branches_),
      clocks_(other.clocks_),
      accuracies_{accuracy},
      relaxed_(other.relaxed_) {
  restart();
}

template <int Dim>
void ViscousHistory<Dim>::restart() {
  const auto I = algebra::symmetric_identity<Scalar>();
  const std::int64_t n_blocks = placed_.n_strips() * placed_.width();
  const Branch identity{I, I};
  now_ = 0;
  n_asked_ = 1;
  for (State& state : states_)
    state = {0, 0, {}};
  states_[0].used = n_asked_;
  states_[0].branches.assign(static_cast<size_t>(n_blocks * n_branches()), identity);
  if (!relaxed_ || clocks_.empty()) return;
  const functions::PlacedProgram::Instant start = placed_.at(0);
  placed_.for_strips([&](std::int64_t strip, functions::PlacedProgram::Workspace& workspace) {
    relax(start, strip, workspace);
  });
}

/// A = C^-1, S = G^-1 of a strip at t = 0.
template <int Dim>
void ViscousHistory<Dim>::relax(const functions::PlacedProgram::Instant& start,
                                std::int64_t strip,
                                functions::PlacedProgram::Workspace& workspace) {
  placed_.evaluate(strip, 0, start, workspace);
  const DeformationGradient<Dim> gradient(placed_, strip, start, workspace);
  for (int w = 0; w < placed_.width(); ++w) {
    const Drives<Dim> drives = drives_of(gradient.at(w));
    Branch* const branch = &states_[0].branches[(strip * placed_.width() + w) * n_branches()];
    for (std::int64_t k = 0; k < n_branches(); ++k)
      branch[k] = {drives.inverse_C, drives.inverse_G};
  }
}

/// Finds for every rule how long its intervals may be, at some of the places.
template <int Dim>
void ViscousHistory<Dim>::calibrate(double end, std::span<const Vec3> X) {
  constexpr std::int64_t n_samples = 2 * algebra::n_lanes;
  std::vector<Vec3> sample;
  const auto n = static_cast<std::int64_t>(X.size());
  for (std::int64_t k = 0; k < n_samples; ++k)
    sample.push_back(X[static_cast<size_t>(k * (n - 1) / (n_samples - 1))]);
  for (const int n_points : {2, 3, 4}) {
    const double longest = longest_interval(n_points, end, 1 << 8, sample);
    if (longest > 0) accuracies_.push_back({n_points, longest});
  }
  const double longest = longest_interval(6, end, 1 << 16, sample);
  if (!(longest > 0)) {
    throw base::InputError(
        "manufactured.displacement: the internal variables cannot be integrated in time to 1e-13; "
        "write a motion that is smooth up to time.end");
  }
  accuracies_.push_back({6, longest});
}

/// @return the longest interval at which halving changes nothing, 0 where `most` are too few
template <int Dim>
double ViscousHistory<Dim>::longest_interval(int n_points,
                                             double end,
                                             int most,
                                             std::span<const Vec3> sample) const {
  constexpr int n_times = 8;
  for (int n = n_times; n <= most; n *= 2) {
    ViscousHistory coarse(*this, sample, {n_points, end / n});
    ViscousHistory fine(*this, sample, {n_points, end / (2 * n)});
    double error[2] = {0, 0}, scale[2] = {1, 1e-3};
    for (int k = 1; k <= n_times; ++k) {
      coarse.move_to(end * k / n_times);
      fine.move_to(end * k / n_times);
      const size_t n_all = coarse.states_[coarse.now_].branches.size();
      for (size_t i = 0; i < n_all; ++i) {
        const Branch &p = coarse.at(0)[i], &q = fine.at(0)[i];
        for (const bool of_G : {false, true}) {
          const auto& c = of_G ? p.S : p.A;
          const auto& f = of_G ? q.S : q.A;
          for (const int part : {0, 1}) {
            error[part] = std::max(error[part], largest<Dim>(c + (-1.0) * f, part == 1));
            scale[part] = std::max(scale[part], largest<Dim>(f, part == 1));
          }
        }
      }
    }
    if (error[0] <= accuracy_wanted * scale[0] && error[1] <= accuracy_wanted * scale[1])
      return end / (2 * n);
  }
  return 0;
}

template <int Dim>
auto ViscousHistory<Dim>::plan(double from, double to) const -> Plan {
  const double length = to - from;
  const auto fits = [&](const Accuracy& a) { return length <= a.longest; };
  auto accuracy = std::find_if(accuracies_.begin(), accuracies_.end(), fits);
  if (accuracy == accuracies_.end()) accuracy = accuracies_.end() - 1;
  Plan plan;
  plan.n_intervals = std::max(1, static_cast<int>(std::ceil(length / accuracy->longest - 1e-9)));
  const double interval = length / plan.n_intervals;
  for (const Clock& clock : clocks_) {
    plan.rule.push_back(exponential_gauss(accuracy->n_points, interval / clock.tau));
    auto& points = plan.at_time.emplace_back();
    for (int k = 0; k < plan.n_intervals; ++k) {
      for (const double theta : plan.rule.back().theta) {
        const double t = from + (k + theta) * interval;
        points.push_back({t, placed_.at(t)});
      }
    }
  }
  return plan;
}

template <int Dim>
void ViscousHistory<Dim>::integrate(const Plan& plan,
                                    const State& from,
                                    State& to,
                                    std::int64_t strip,
                                    functions::PlacedProgram::Workspace& workspace) const {
  const std::int64_t width = placed_.width();
  const auto begin = static_cast<size_t>(strip * width * n_branches());
  for (size_t c = 0; c < clocks_.size(); ++c) {
    const Clock& clock = clocks_[c];
    const ExponentialGauss& rule = plan.rule[c];
    const size_t n_points = rule.theta.size();
    for (size_t k = 0; k < plan.at_time[c].size(); ++k) {
      const double old = k % n_points == 0 ? rule.old : 1, weight = rule.weight[k % n_points];
      const auto& point = plan.at_time[c][k];
      placed_.evaluate(strip, point.t, point.instant, workspace);
      const DeformationGradient<Dim> gradient(placed_, strip, point.instant, workspace);
      const State& before = k == 0 ? from : to;
      for (int w = 0; w < width; ++w) {
        const size_t block = begin + static_cast<size_t>(w * n_branches());
        const Branch* const old_branch = &before.branches[block];
        Branch* const branch = &to.branches[block];
        const Drives<Dim> drives = drives_of(gradient.at(w));
        for (const int i : clock.C)
          branch[i].A = old * old_branch[i].A + weight * drives.inverse_C;
        for (const int i : clock.G)
          branch[i].S = old * old_branch[i].S + weight * drives.inverse_G;
      }
    }
  }
}

template <int Dim>
void ViscousHistory<Dim>::move_to(double t) {
  if (clocks_.empty()) return;
  const auto holds = [](const State& state) { return state.used > 0; };
  size_t from = states_.size(), oldest = 0;
  for (size_t k = 0; k < states_.size(); ++k) {
    State& state = states_[k];
    if (holds(state) && state.time == t) {
      state.used = ++n_asked_;
      now_ = k;
      return;
    }
    const bool is_before = holds(state) && state.time < t;
    if (is_before && (from == states_.size() || state.time > states_[from].time)) from = k;
  }
  if (from == states_.size()) {
    restart();
    return move_to(t);
  }
  for (size_t k = 0; k < states_.size(); ++k) {
    const bool replaces = oldest == from || states_[k].used < states_[oldest].used;
    if (k != from && replaces) oldest = k;
  }
  const Plan way = plan(states_[from].time, t);
  State& to = states_[oldest];
  // those that do not relax are the same at all times
  if (to.branches.size() != states_[from].branches.size()) to.branches = states_[from].branches;
  placed_.for_strips([&](std::int64_t strip, functions::PlacedProgram::Workspace& workspace) {
    integrate(way, states_[from], to, strip, workspace);
  });
  to.time = t;
  to.used = ++n_asked_;
  now_ = oldest;
}

template <int Dim>
void ViscousHistory<Dim>::archive(algebra::Archive& archive) {
  auto now = static_cast<std::int64_t>(now_);
  archive.integer("known state/now", now);
  archive.integer("known state/times asked for", n_asked_);
  now_ = static_cast<size_t>(now);
  for (size_t k = 0; k < states_.size(); ++k) {
    State& state = states_[k];
    const std::string name = fmt::format("known state/{} of 3", k);
    archive.real(name + " time", "s", state.time);
    archive.integer(name + " asked for", state.used);
    if (archive.is_loading() && state.used > 0)
      state.branches.resize(
          static_cast<size_t>(placed_.n_strips() * placed_.width() * n_branches()));
    // value and gradient of the components of A and of S, lane by lane
    std::vector<double> values;
    const auto for_each = [&](const auto& use) {
      for (Branch& branch : state.branches) {
        for (auto* tensor : {&branch.A, &branch.S}) {
          for (Scalar& component : tensor->s) {
            for (int d = -1; d < Dim; ++d) {
              Lanes& lanes = d < 0 ? component.v : component.d[d];
              for (int lane = 0; lane < algebra::n_lanes; ++lane)
                use(lanes, lane);
            }
          }
        }
      }
    };
    for_each([&](Lanes& lanes, int lane) { values.push_back(lanes[lane]); });
    archive.reals(name, "-", values, 1, static_cast<std::int64_t>(values.size()));
    size_t i = 0;
    for_each([&](Lanes& lanes, int lane) { lanes[lane] = values[i++]; });
  }
}

template class ViscousHistory<2>;
template class ViscousHistory<3>;

}  // namespace diptych::exact
