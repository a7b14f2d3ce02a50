#include "common/exact/manufactured/manufactured_solution.hpp"

#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"

#include <fmt/format.h>
#include <limits>

namespace diptych::exact {

using algebra::n_lanes;

namespace {

/// Nodes in blocks of eight; the last one is filled up with its last node.
std::vector<LanePlace> lane_places(const std::vector<Vec3>& X) {
  std::vector<LanePlace> places((X.size() + n_lanes - 1) / n_lanes);
  for (size_t a = 0; a < places.size() * n_lanes; ++a) {
    const Vec3& from = X[std::min(a, X.size() - 1)];
    for (int i = 0; i < 3; ++i)
      places[a / n_lanes].X[i][a % n_lanes] = from[i];
  }
  return places;
}

template <int Dim>
Mat3 value_at(const algebra::Tensor<algebra::Dual<Lanes, Dim>>& A, int lane) {
  Mat3 M;
  for (int k = 0; k < 9; ++k)
    M(k / 3, k % 3) = A(k / 3, k % 3).v[lane];
  return M;
}

template <int Dim>
Mat3 value_at(const algebra::SymmetricTensor<algebra::Dual<Lanes, Dim>>& A, int lane) {
  Mat3 M;
  for (int k = 0; k < 9; ++k)
    M(k / 3, k % 3) = A(k / 3, k % 3).v[lane];
  return M;
}

}  // namespace

template <int Dim>
ManufacturedSolution<Dim>::ManufacturedSolution(std::shared_ptr<const Motion> motion,
                                                const std::vector<Vec3>& X,
                                                std::vector<physics::MaxwellBranch> branches,
                                                double rho_R,
                                                bool relaxed,
                                                double end,
                                                Stress stress)
    : motion_(std::move(motion)),
      X_(X),
      places_(lane_places(X)),
      rho_R_(rho_R),
      stress_of_(std::move(stress)),
      history_(*motion_, places_, std::move(branches), relaxed, end),
      time_(std::numeric_limits<double>::quiet_NaN()),
      body_force_(X.size()),
      F_(X.size()),
      P_(X.size()) {
  move_to(0);
}

template <int Dim>
void ManufacturedSolution<Dim>::move_to(double t) {
  if (t == time_) return;
  history_.move_to(t);
  at_time_ = motion_->tape().at_time(t);
  parallel::for_chunks(static_cast<std::int64_t>(places_.size()),
                       [&](auto begin, auto end, auto) { evaluate(begin, end); });
  time_ = t;
  check();
}

/// f_i = rho_R a_i - sum_I dP_iI/dX_I of blocks [begin, end).
template <int Dim>
void ManufacturedSolution<Dim>::evaluate(std::int64_t begin, std::int64_t end) {
  TapeEvaluation<Lanes, Dim, true> evaluated(motion_->tape());
  for (std::int64_t b = begin; b < end; ++b) {
    evaluated.place(places_[b].X);
    evaluated.time(at_time_);
    const auto F = deformation_gradient<Dim>(*motion_, evaluated);
    algebra::Tensor<Scalar> P;
    stress_of_(F, history_.at(b), P);
    Lanes force[3] = {Lanes{}, Lanes{}, Lanes{}};
    for (int i = 0; i < Dim; ++i) {
      const auto& u = evaluated[motion_->component(i)];
      force[i] = rho_R_ * u.dd[u.index(Dim, Dim)];
      for (int I = 0; I < Dim; ++I)
        force[i] = force[i] - P(i, I).d[I];
    }
    const std::int64_t first = b * n_lanes;
    const auto n_nodes = static_cast<std::int64_t>(X_.size());
    for (int lane = 0; lane < n_lanes && first + lane < n_nodes; ++lane) {
      body_force_[first + lane] = {force[0][lane], force[1][lane], force[2][lane]};
      F_[first + lane] = value_at<Dim>(F, lane);
      P_[first + lane] = value_at<Dim>(P, lane);
    }
  }
}

template <int Dim>
void ManufacturedSolution<Dim>::check() const {
  for (size_t a = 0; a < X_.size(); ++a) {
    const double J = F_[a].determinant();
    if (J > 0 && body_force_[a].allFinite() && P_[a].allFinite()) continue;
    throw base::InputError(fmt::format(
        "manufactured.displacement gives {} at the node at ({:g}, {:g}, {:g}), t = {:g}; write a "
        "motion that is smooth and keeps J > 0 in the whole body up to time.end",
        J <= 0 ? fmt::format("J = {:g}", J) : "a value that is not finite", X_[a][0], X_[a][1],
        X_[a][2], time_));
  }
}

template <int Dim>
scheme::Snapshot ManufacturedSolution<Dim>::snapshot(double t) {
  move_to(t);
  const size_t n = X_.size();
  scheme::Snapshot s;
  s.time = t;
  s.F = F_;
  s.P = P_;
  for (size_t a = 0; a < n; ++a) {
    s.u.push_back(motion_->displacement(X_[a], t));
    s.v.push_back(motion_->velocity(X_[a], t));
    const auto X = physics::deformation_of(algebra::to_tensor(F_[a]));
    s.H.push_back(algebra::to_eigen(X.H));
    s.J.push_back(X.J);
  }
  for (std::int64_t k = 0; k < history_.n_branches(); ++k) {
    auto& A = s.A.emplace_back(n);
    auto& S = s.S.emplace_back(n);
    for (size_t a = 0; a < n; ++a) {
      const Branch& branch = history_.at(static_cast<std::int64_t>(a / n_lanes))[k];
      A[a] = value_at<Dim>(branch.A, static_cast<int>(a % n_lanes));
      S[a] = value_at<Dim>(branch.S, static_cast<int>(a % n_lanes));
    }
  }
  return s;
}

template <int Dim>
void ManufacturedSolution<Dim>::archive(algebra::Archive& archive) {
  double time = time_;
  archive.real("known state/time", "s", time);
  history_.archive(archive);
  if (!archive.is_loading()) return;
  time_ = std::numeric_limits<double>::quiet_NaN();
  move_to(time);
}

template class ManufacturedSolution<2>;
template class ManufacturedSolution<3>;

}  // namespace diptych::exact
