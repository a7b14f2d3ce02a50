#include "common/exact/manufactured/viscous_history.hpp"

#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

/// Times and weights of the way from one time to another.
template <int Dim>
struct ViscousHistory<Dim>::Plan {
  int n_intervals = 0;
  std::vector<ExponentialGauss> rule;            ///< [clock]
  std::vector<std::vector<TimeValues>> at_time;  ///< [clock][interval * n_points + point]
};

template <int Dim>
ViscousHistory<Dim>::ViscousHistory(const Motion& motion,
                                    std::vector<LanePlace> places,
                                    std::vector<physics::MaxwellBranch> branches,
                                    bool relaxed,
                                    double end)
    : motion_(&motion),
      places_(std::move(places)),
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
  if (!clocks_.empty()) calibrate(end);
  restart();
}

template <int Dim>
ViscousHistory<Dim>::ViscousHistory(const ViscousHistory& other,
                                    std::vector<LanePlace> places,
                                    Accuracy accuracy)
    : motion_(other.motion_),
      places_(std::move(places)),
      branches_(other.branches_),
      clocks_(other.clocks_),
      accuracies_{accuracy},
      relaxed_(other.relaxed_) {
  restart();
}

template <int Dim>
void ViscousHistory<Dim>::restart() {
  base_time_ = latest_time_ = 0;
  const auto I = algebra::symmetric_identity<Scalar>();
  latest_.assign(places_.size() * branches_.size(), Branch{I, I});
  if (relaxed_ && !clocks_.empty()) {
    TapeEvaluation<Lanes, Dim, false> evaluated(motion_->tape());
    const TimeValues start = motion_->tape().at_time(0);
    for (size_t b = 0; b < places_.size(); ++b) {
      evaluated.place(places_[b].X);
      evaluated.time(start);
      physics::Deformation<Scalar> X;
      X.F = deformation_gradient<Dim>(*motion_, evaluated);
      const Branch relaxed{physics::inverse_C(X), physics::inverse_G(X)};
      std::fill_n(latest_.begin() + static_cast<std::ptrdiff_t>(b * branches_.size()),
                  branches_.size(), relaxed);
    }
  }
  base_ = latest_;
}

/// Finds for every rule how long its intervals may be, at some of the places.
template <int Dim>
void ViscousHistory<Dim>::calibrate(double end) {
  for (const int n_points : {2, 3, 4}) {
    const double longest = longest_interval(n_points, end, 1 << 8);
    if (longest > 0) accuracies_.push_back({n_points, longest});
  }
  const double longest = longest_interval(6, end, 1 << 16);
  if (!(longest > 0)) {
    throw base::InputError(
        "manufactured.displacement: the internal variables cannot be integrated in time to 1e-13; "
        "write a motion that is smooth up to time.end");
  }
  accuracies_.push_back({6, longest});
}

/// @return the longest interval at which halving changes nothing, 0 where `most` are too few
template <int Dim>
double ViscousHistory<Dim>::longest_interval(int n_points, double end, int most) const {
  constexpr int n_samples = 2, n_times = 8;
  std::vector<LanePlace> sample;  // places of all blocks take part: lane by lane another block
  const auto n_blocks = static_cast<std::int64_t>(places_.size());
  for (int s = 0; s < n_samples; ++s) {
    LanePlace place = places_[0];
    for (int lane = 0; lane < algebra::n_lanes; ++lane) {
      const std::int64_t rank = s * algebra::n_lanes + lane;
      const std::int64_t block = rank * (n_blocks - 1) / (n_samples * algebra::n_lanes - 1);
      for (int i = 0; i < 3; ++i)
        place.X[i][lane] = places_[block].X[i][(5 * rank + 3 * s) % algebra::n_lanes];
    }
    sample.push_back(place);
  }
  for (int n = n_times; n <= most; n *= 2) {
    ViscousHistory coarse(*this, sample, {n_points, end / n});
    ViscousHistory fine(*this, sample, {n_points, end / (2 * n)});
    double error[2] = {0, 0}, scale[2] = {1, 1e-3};
    for (int k = 1; k <= n_times; ++k) {
      coarse.move_to(end * k / n_times);
      fine.move_to(end * k / n_times);
      for (size_t i = 0; i < coarse.latest_.size(); ++i) {
        for (const bool of_G : {false, true}) {
          const auto& c = of_G ? coarse.latest_[i].S : coarse.latest_[i].A;
          const auto& f = of_G ? fine.latest_[i].S : fine.latest_[i].A;
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
    std::vector<TimeValues>& times = plan.at_time.emplace_back();
    for (int k = 0; k < plan.n_intervals; ++k) {
      for (const double theta : plan.rule.back().theta)
        times.push_back(motion_->tape().at_time(from + (k + theta) * interval));
    }
  }
  return plan;
}

template <int Dim>
void ViscousHistory<Dim>::integrate(const Plan& plan, std::int64_t begin, std::int64_t end) {
  TapeEvaluation<Lanes, Dim, false> evaluated(motion_->tape());
  for (std::int64_t b = begin; b < end; ++b) {
    evaluated.place(places_[b].X);
    Branch* branch = &latest_[b * n_branches()];
    for (size_t c = 0; c < clocks_.size(); ++c) {
      const Clock& clock = clocks_[c];
      const ExponentialGauss& rule = plan.rule[c];
      const size_t n_points = rule.theta.size();
      for (size_t k = 0; k < plan.at_time[c].size(); ++k) {
        const double old = k % n_points == 0 ? rule.old : 1, weight = rule.weight[k % n_points];
        evaluated.time(plan.at_time[c][k]);
        physics::Deformation<Scalar> X;
        X.F = deformation_gradient<Dim>(*motion_, evaluated);
        if (!clock.C.empty()) {
          const auto B = weight * physics::inverse_C(X);
          for (const int i : clock.C)
            branch[i].A = old * branch[i].A + B;
        }
        if (clock.G.empty()) continue;
        const auto B = weight * physics::inverse_G(X);
        for (const int i : clock.G)
          branch[i].S = old * branch[i].S + B;
      }
    }
  }
}

template <int Dim>
void ViscousHistory<Dim>::move_to(double t) {
  if (clocks_.empty() || t == latest_time_) return;
  if (t < base_time_) restart();
  if (t > latest_time_) {
    base_ = latest_;
    base_time_ = latest_time_;
  } else {
    latest_ = base_;
    latest_time_ = base_time_;
  }
  if (t == latest_time_) return;
  const Plan way = plan(base_time_, t);
  parallel::for_chunks(static_cast<std::int64_t>(places_.size()),
                       [&](auto begin, auto end, auto) { integrate(way, begin, end); });
  latest_time_ = t;
}

template <int Dim>
void ViscousHistory<Dim>::archive(algebra::Archive& archive) {
  archive.real("known state/time of base", "s", base_time_);
  archive.real("known state/time of latest", "s", latest_time_);
  for (std::vector<Branch>* branches : {&base_, &latest_}) {
    // value and gradient of the components of A and of S, lane by lane
    std::vector<double> values;
    const auto for_each = [&](const auto& use) {
      for (Branch& branch : *branches) {
        for (auto* tensor : {&branch.A, &branch.S}) {
          for (Scalar& component : tensor->s) {
            for (int k = -1; k < Dim; ++k) {
              Lanes& lanes = k < 0 ? component.v : component.d[k];
              for (int lane = 0; lane < algebra::n_lanes; ++lane)
                use(lanes, lane);
            }
          }
        }
      }
    };
    for_each([&](Lanes& lanes, int lane) { values.push_back(lanes[lane]); });
    archive.reals(branches == &base_ ? "known state/base" : "known state/latest", "-", values, 1,
                  static_cast<std::int64_t>(values.size()));
    size_t k = 0;
    for_each([&](Lanes& lanes, int lane) { lanes[lane] = values[k++]; });
  }
}

template class ViscousHistory<2>;
template class ViscousHistory<3>;

}  // namespace diptych::exact
