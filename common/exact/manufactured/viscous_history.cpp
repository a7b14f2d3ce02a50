#include "common/exact/manufactured/viscous_history.hpp"

#include "common/base/error.hpp"
#include "common/exact/manufactured/viscous_drives.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <string>

namespace diptych::exact {

namespace {

constexpr double accuracy_wanted =
    1e-13;  // of means of C^-1 and of their gradients, relative to their size

/// Times from 0 to `last`.
std::vector<double> evenly(double last, int n) {
  std::vector<double> times;
  for (int k = 0; k < n; ++k)
    times.push_back(last * k / (n - 1));
  return times;
}
/// Intervals of this length that half overlap.
int n_covering(double whole, double length) {
  return 2 * static_cast<int>(std::lround(whole / length)) - 1;
}
/// Where the halves of the intervals that err most begin: what is hard in them lies in one of
/// these.
std::vector<double> halves_of(const std::vector<double>& begins,
                              const std::vector<double>& errors,
                              double length) {
  constexpr size_t most = 12;
  std::vector<size_t> order(begins.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t p, size_t q) { return errors[p] > errors[q]; });
  std::vector<double> halves;
  for (size_t k = 0; k < std::min(most, order.size()); ++k) {
    halves.push_back(begins[order[k]]);
    halves.push_back(begins[order[k]] + length / 2);
  }
  return halves;
}

std::vector<int> joined(std::vector<int> first, const std::vector<int>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

template <int Dim>
ViscousHistory<Dim>::ViscousHistory(const Motion& motion,
                                    const std::vector<int>& results,
                                    std::span<const Vec3> X,
                                    std::vector<physics::MaxwellBranch> branches,
                                    bool relaxed,
                                    double end)
    : motion_(&motion),
      placed_(motion.program(), joined(motion.gradients(), results), X),
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
  states_ = {};
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
    Branch* const branch = &states_[0].branches[(strip * placed_.width() + w) * n_branches()];
    for_drives(gradient, w, [&](auto direction, const Drives& drives) DIPTYCH_INLINE_LAMBDA {
      for (std::int64_t k = 0; k < n_branches(); ++k) {
        add_drive<direction>(drives.inverse_C, false, 0, branch[k].A, 1, branch[k].A);
        add_drive<direction>(drives.inverse_G, true, 0, branch[k].S, 1, branch[k].S);
      }
    });
  }
}

/// Finds for every rule how long its intervals may be, at some of the places. What an interval
/// takes to A is the mean of C^-1 over it, weighed by the exponential, so that A errs by no more
/// than these means do, however many intervals there are.
template <int Dim>
void ViscousHistory<Dim>::calibrate(double end, std::span<const Vec3> X) {
  constexpr std::int64_t n_samples = 2 * algebra::n_lanes;
  std::vector<Vec3> sample;
  const auto n = static_cast<std::int64_t>(X.size());
  for (std::int64_t k = 0; k < n_samples; ++k)
    sample.push_back(X[static_cast<size_t>(k * (n - 1) / (n_samples - 1))]);
  constexpr int most_intervals = 1 << 16, most_looks = 32;
  double longest = end / 8;
  std::vector<double> begins = evenly(end - longest, n_covering(end, longest));
  for (const int n_points : {6, 5, 4, 3, 2}) {
    for (; longest * most_intervals >= end; longest /= 2) {
      const std::vector<double> errors = errors_of(n_points, longest, begins, sample);
      if (*std::max_element(errors.begin(), errors.end()) <= accuracy_wanted) break;
      begins = halves_of(begins, errors, longest);
      const std::vector<double> others =
          evenly(end - longest / 2, std::min(most_looks, n_covering(end, longest / 2)));
      begins.insert(begins.end(), others.begin(), others.end());
    }
    if (!(longest * most_intervals >= end)) break;
    accuracies_.insert(accuracies_.begin(), {n_points, longest});
  }
  if (accuracies_.empty()) {
    throw base::InputError(
        "manufactured.displacement: the internal variables cannot be integrated in time to 1e-13; "
        "write a motion that is smooth up to time.end");
  }
}

/// Of intervals of this length that begin at these times: how far the means of C^-1 and G^-1, or
/// their gradients, are from those by two intervals of half the length, relative to their size.
template <int Dim>
std::vector<double> ViscousHistory<Dim>::errors_of(int n_points,
                                                   double length,
                                                   std::span<const double> begins,
                                                   std::span<const Vec3> sample) const {
  ViscousHistory coarse(*this, sample, {n_points, length});
  ViscousHistory fine(*this, sample, {n_points, length / 2});
  std::vector<double> errors;
  for (const double begin : begins) {
    const std::vector<Branch>& p = coarse.taken_in(begin, length);
    const std::vector<Branch>& q = fine.taken_in(begin, length);
    double error[2] = {0, 0}, scale[2] = {1, 1e-3};  // of values, of gradients
    const auto compare = [&](const auto& of_coarse, const auto& of_fine, double share) {
      for (int s = 0; s < 6; ++s) {
        for (int d = -1; d < Dim; ++d) {
          const int part = d < 0 ? 0 : 1;
          const Lanes& c = d < 0 ? of_coarse.s[s].v : of_coarse.s[s].d[d];
          const Lanes& f = d < 0 ? of_fine.s[s].v : of_fine.s[s].d[d];
          for (int lane = 0; lane < algebra::n_lanes; ++lane) {
            error[part] = std::max(error[part], std::abs(c[lane] - f[lane]) / share);
            scale[part] = std::max(scale[part], std::abs(f[lane]) / share);
          }
        }
      }
    };
    for (const Clock& clock : clocks_) {
      const double share = -std::expm1(-length / clock.tau);
      for (size_t i = 0; i < p.size(); ++i) {
        const int branch = static_cast<int>(static_cast<std::int64_t>(i) % n_branches());
        if (std::find(clock.C.begin(), clock.C.end(), branch) != clock.C.end())
          compare(p[i].A, q[i].A, share);
        if (std::find(clock.G.begin(), clock.G.end(), branch) != clock.G.end())
          compare(p[i].S, q[i].S, share);
      }
    }
    errors.push_back(std::max(error[0] / scale[0], error[1] / scale[1]));
  }
  return errors;
}

/// What an interval adds to the branches.
template <int Dim>
auto ViscousHistory<Dim>::taken_in(double begin, double length) -> const std::vector<Branch>& {
  restart();
  states_[0].time = begin;
  std::fill(states_[0].branches.begin(), states_[0].branches.end(), Branch{});
  return branches_at(begin + length);
}

template <int Dim>
void ViscousHistory<Dim>::plan(Way& way) const {
  const double start = states_[way.from].time, length = way.to_time - start;
  const auto fits = [&](const Accuracy& a) { return length <= a.longest; };
  auto accuracy = std::find_if(accuracies_.begin(), accuracies_.end(), fits);
  if (accuracy == accuracies_.end()) accuracy = accuracies_.end() - 1;
  const int n_intervals =
      std::max(1, static_cast<int>(std::ceil(length / accuracy->longest - 1e-9)));
  const double interval = length / n_intervals;
  const auto slowest = std::max_element(clocks_.begin(), clocks_.end(),
                                        [](auto& p, auto& q) { return p.tau < q.tau; });
  const ExponentialGauss gauss = exponential_gauss(accuracy->n_points, interval / slowest->tau);
  for (const Clock& clock : clocks_) {
    way.rules.push_back(
        clock.tau == slowest->tau ? gauss : exponential_rule(gauss.theta, interval / clock.tau));
  }
  for (int k = 0; k < n_intervals; ++k) {
    for (const double theta : gauss.theta) {
      const double t = start + (k + theta) * interval;
      way.points.push_back({t, placed_.at(t)});
    }
  }
}

template <int Dim>
auto ViscousHistory<Dim>::way_to(double t) -> Way {
  Way way;
  way.to_time = t;
  if (clocks_.empty()) return way;  // the same at all times
  constexpr size_t none = ~size_t{0};
  size_t latest = 0, oldest = 0, empty = none;
  way.from = none;
  for (size_t k = 0; k < states_.size(); ++k) {
    const State& state = states_[k];
    if (!state.holds()) {
      empty = k;
      continue;
    }
    if (state.time > states_[latest].time) latest = k;
    if (state.time < states_[oldest].time) oldest = k;
    if (state.time <= t && (way.from == none || state.time > states_[way.from].time)) way.from = k;
  }
  if (way.from == none) {
    restart();
    way = way_to(t);
    way.begins_anew_ = true;
    return way;
  }
  way.to = way.from;
  if (t == states_[way.from].time) return way;
  way.is_kept = way.from == latest;
  way.to = empty != none ? empty : oldest;
  plan(way);
  // those that do not relax are the same at all times
  if (way.is_kept && empty != none) states_[way.to].branches = states_[way.from].branches;
  return way;
}

template <int Dim>
auto ViscousHistory<Dim>::follow(const Way& way,
                                 std::int64_t strip,
                                 functions::PlacedProgram::Workspace& workspace,
                                 Branch* room) -> const Branch* {
  const Branch* const from = states_[way.from].branches.data() + strip * branches_of_strip();
  if (way.from == way.to) return from;
  Branch* const to =
      way.is_kept ? states_[way.to].branches.data() + strip * branches_of_strip() : room;
  if (!way.is_kept) std::copy_n(from, branches_of_strip(), to);
  integrate(way, strip, workspace, from, to);
  return to;
}

template <int Dim>
void ViscousHistory<Dim>::integrate(const Way& way,
                                    std::int64_t strip,
                                    functions::PlacedProgram::Workspace& workspace,
                                    const Branch* from,
                                    Branch* to) const {
  const size_t n_points = way.rules.front().theta.size();
  for (size_t k = 0; k < way.points.size(); ++k) {
    const typename Way::Point& point = way.points[k];
    placed_.evaluate(strip, point.t, point.instant, workspace);
    const DeformationGradient<Dim> gradient(placed_, strip, point.instant, workspace);
    const Branch* const before = k == 0 ? from : to;
    for (int w = 0; w < placed_.width(); ++w) {
      const Branch* const old_branch = before + w * n_branches();
      Branch* const branch = to + w * n_branches();
      for_drives(gradient, w, [&](auto direction, const Drives& drives) DIPTYCH_INLINE_LAMBDA {
        for (size_t c = 0; c < clocks_.size(); ++c) {
          const ExponentialGauss& rule = way.rules[c];
          const double old = k % n_points == 0 ? rule.old : 1, weight = rule.weight[k % n_points];
          for (const int i : clocks_[c].C)
            add_drive<direction>(drives.inverse_C, false, old, old_branch[i].A, weight,
                                 branch[i].A);
          for (const int i : clocks_[c].G)
            add_drive<direction>(drives.inverse_G, true, old, old_branch[i].S, weight, branch[i].S);
        }
      });
    }
  }
}

template <int Dim>
void ViscousHistory<Dim>::arrive(const Way& way) {
  if (way.from != way.to && way.is_kept) states_[way.to].time = way.to_time;
}

template <int Dim>
auto ViscousHistory<Dim>::branches_at(double t) -> const std::vector<Branch>& {
  const Way way = way_to(t);
  if (!way.is_kept) passing_ = states_[way.from].branches;
  placed_.for_strips([&](std::int64_t strip, functions::PlacedProgram::Workspace& workspace) {
    (void)follow(way, strip, workspace,
                 way.is_kept ? nullptr : passing_.data() + strip * branches_of_strip());
  });
  arrive(way);
  return way.is_kept ? states_[way.to].branches : passing_;
}

template <int Dim>
void ViscousHistory<Dim>::archive(algebra::Archive& archive) {
  for (size_t k = 0; k < states_.size(); ++k) {
    State& state = states_[k];
    const std::string name = fmt::format("known state/{} of 3", k);
    std::int64_t is_held = state.holds() ? 1 : 0;
    archive.real(name + " time", "s", state.time);
    archive.integer(name + " is held", is_held);
    if (archive.is_loading())
      state.branches.resize(
          static_cast<size_t>(is_held * placed_.n_strips() * branches_of_strip()));
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
