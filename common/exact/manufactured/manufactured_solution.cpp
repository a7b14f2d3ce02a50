#include "common/exact/manufactured/manufactured_solution.hpp"

#include "common/base/error.hpp"
#include "common/functions/placed_values.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::exact {

using algebra::n_lanes;

namespace {

constexpr double no_time = std::numeric_limits<double>::quiet_NaN();

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
      rho_R_(rho_R),
      stress_of_(std::move(stress)),
      history_(*motion_, motion_->rates(2), X_, std::move(branches), relaxed, end) {
  const auto n = static_cast<std::int64_t>(X.size());
  for (Loads& loads : loads_)
    loads = {no_time, algebra::BlockField(n, Dim), algebra::BlockField(n, 9)};
  move_to(0);
}

template <int Dim>
void ManufacturedSolution<Dim>::move_to(double t) {
  if (t == loads_[now_].time) return;
  now_ = 1 - now_;
  Loads& loads = loads_[now_];
  if (t == loads.time) return;
  const typename ViscousHistory<Dim>::Way way = history_.way_to(t);
  // what goes on from a checkpoint here has no states of before either
  if (way.begins_anew()) loads_[1 - now_].time = no_time;
  const Program& placed = history_.placed();
  const Program::Instant instant = placed.at(t);
  std::vector<char> is_sound(static_cast<size_t>(placed.n_strips()));
  placed.for_strips([&](std::int64_t strip, Program::Workspace& workspace) {
    thread_local std::vector<Branch> room;  // as large as a strip, and asked for by each of them
    room.resize(static_cast<size_t>(history_.branches_of_strip()));
    const Branch* const branches = history_.follow(way, strip, workspace, room.data());
    is_sound[static_cast<size_t>(strip)] = evaluate(strip, t, instant, branches, workspace, loads);
  });
  history_.arrive(way);
  loads.time = t;
  const auto unsound = std::find(is_sound.begin(), is_sound.end(), 0);
  if (unsound == is_sound.end()) return;
  loads.time = no_time;
  refuse_strip(unsound - is_sound.begin(), t);
}

/// f_i = rho_R a_i - sum_I dP_iI/dX_I of a strip. @return whether J > 0 and all is finite
template <int Dim>
bool ManufacturedSolution<Dim>::evaluate(std::int64_t strip,
                                         double t,
                                         const Program::Instant& instant,
                                         const Branch* branches,
                                         Program::Workspace& workspace,
                                         Loads& loads) {
  const Program& placed = history_.placed();
  placed.evaluate(strip, t, instant, workspace);
  const DeformationGradient<Dim> gradient(placed, strip, instant, workspace);
  Program::Blocks acceleration[Dim];
  for (int i = 0; i < Dim; ++i) {
    acceleration[i] =
        placed.result(DeformationGradient<Dim>::n_rows + i, strip, instant, workspace);
  }
  const std::int64_t n_blocks = algebra::n_blocks_of(static_cast<std::int64_t>(X_.size()));
  bool is_sound = true;
  for (int w = 0; w < placed.width(); ++w) {
    const std::int64_t b = strip * placed.width() + w;
    if (b >= n_blocks) break;
    BlockStress<Dim> stress;
    stress_of_(gradient.at(w), branches + w * history_.n_branches(), stress);
    Lanes all = Lanes{};  // times zero: zero, or no number
    for (int i = 0; i < Dim; ++i) {
      const Lanes force = rho_R_ * acceleration[i][w] - stress.divergence[i];
      loads.body_forces.put(b, i, force);
      all = all + 0.0 * force;
    }
    for (int k = 0; k < 9; ++k) {
      loads.P.put(b, k, stress.P(k / 3, k % 3));
      all = all + 0.0 * stress.P(k / 3, k % 3);
    }
    is_sound = is_sound && algebra::all_below(all - stress.J, 0);
  }
  return is_sound;
}

template <int Dim>
void ManufacturedSolution<Dim>::refuse_strip(std::int64_t strip, double t) const {
  const std::int64_t per_strip = history_.placed().width() * n_lanes, first = strip * per_strip;
  const auto n = static_cast<std::int64_t>(X_.size());
  scheme::Snapshot s;
  put_deformations(t, s);
  for (std::int64_t a = first; a < std::min(n, first + per_strip); ++a) {
    bool is_finite = stress(a).allFinite();
    for (int i = 0; i < Dim; ++i)
      is_finite = is_finite && std::isfinite(body_forces().at(a, i));
    const auto at = static_cast<size_t>(a);
    const double J = s.J[at];
    if (J > 0 && is_finite) continue;
    throw base::InputError(fmt::format(
        "manufactured.displacement gives {} at the node at ({:g}, {:g}, {:g}), t = {:g}; write a "
        "motion that is smooth and keeps J > 0 in the whole body up to time.end",
        J <= 0 ? fmt::format("J = {:g}", J) : "a value that is not finite", X_[at][0], X_[at][1],
        X_[at][2], t));
  }
  throw base::InputError("manufactured.displacement gives a value that is not finite");
}

template <int Dim>
Mat3 ManufacturedSolution<Dim>::stress(std::int64_t node) const {
  Mat3 P;
  for (int k = 0; k < 9; ++k)
    P(k / 3, k % 3) = loads_[now_].P.at(node, k);
  return P;
}

/// F, H, J.
template <int Dim>
void ManufacturedSolution<Dim>::put_deformations(double t, scheme::Snapshot& s) const {
  const std::vector<int>& gradients = motion_->gradients();
  const std::vector<int> first(gradients.begin(), gradients.begin() + Dim * Dim);
  const functions::PlacedValues values(motion_->program(), first, X_);
  std::vector<double> of_all(X_.size() * first.size());
  values.at(t, of_all);
  for (size_t a = 0; a < X_.size(); ++a) {
    Mat3 F = Mat3::Identity();
    for (int k = 0; k < Dim * Dim; ++k)
      F(k / Dim, k % Dim) += of_all[a * first.size() + static_cast<size_t>(k)];
    const auto X = physics::deformation_of(algebra::to_tensor(F));
    s.F.push_back(F);
    s.H.push_back(algebra::to_eigen(X.H));
    s.J.push_back(X.J);
  }
}

template <int Dim>
scheme::Snapshot ManufacturedSolution<Dim>::snapshot(double t) {
  move_to(t);
  const size_t n = X_.size();
  scheme::Snapshot s;
  s.time = t;
  s.u = motion_->displacements(X_, t);
  s.v = motion_->velocities(X_, t);
  put_deformations(t, s);
  for (size_t a = 0; a < n; ++a)
    s.P.push_back(stress(static_cast<std::int64_t>(a)));
  if (history_.n_branches() == 0) return s;
  const std::vector<Branch>& branches = history_.branches_at(t);
  for (std::int64_t k = 0; k < history_.n_branches(); ++k) {
    auto& A = s.A.emplace_back(n);
    auto& S = s.S.emplace_back(n);
    for (size_t a = 0; a < n; ++a) {
      const Branch& branch = branches[a / n_lanes * static_cast<size_t>(history_.n_branches()) +
                                      static_cast<size_t>(k)];
      A[a] = value_at<Dim>(branch.A, static_cast<int>(a % n_lanes));
      S[a] = value_at<Dim>(branch.S, static_cast<int>(a % n_lanes));
    }
  }
  return s;
}

template <int Dim>
void ManufacturedSolution<Dim>::archive(algebra::Archive& archive) {
  double time = loads_[now_].time;
  archive.real("known state/time", "s", time);
  history_.archive(archive);
  if (!archive.is_loading()) return;
  for (Loads& loads : loads_)
    loads.time = no_time;
  move_to(time);
}

template class ManufacturedSolution<2>;
template class ManufacturedSolution<3>;

}  // namespace diptych::exact
