#include "benchmarks/material/material_path.hpp"

#include "common/base/error.hpp"
#include "common/base/registry.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace diptych::harness {

namespace {

using run::Mat3;
using run::MaterialPoint;
using run::PointState;
using Unknowns = Eigen::VectorXd;  // none, {l} or {s, l}

constexpr double pi = 3.14159265358979323846;

double control(const MaterialPath& path, double t) {
  switch (path.course) {
    case Course::step:
      return path.amplitude;
    case Course::ramp:
      return path.rate * t;
    default:
      return path.amplitude * std::sin(path.angular_frequency * t);
  }
}
double control_rate(const MaterialPath& path, double t) {
  switch (path.course) {
    case Course::step:
      return 0;
    case Course::ramp:
      return path.rate;
    default:
      return path.amplitude * path.angular_frequency * std::cos(path.angular_frequency * t);
  }
}

Unknowns start(Loading loading) {
  const int n = loading == Loading::uniaxial ? 1 : loading == Loading::creep ? 2 : 0;
  return Unknowns::Ones(n);
}

Mat3 deformation(Loading loading, double a, const Unknowns& q) {
  Mat3 F = Mat3::Identity();
  if (loading == Loading::shear) F(0, 1) = a;
  if (loading == Loading::confined) F(0, 0) = 1 + a;
  if (loading == Loading::uniaxial) F.diagonal() << 1 + a, q[0], q[0];
  if (loading == Loading::creep) F.diagonal() << q[0], q[1], q[1];
  return F;
}

/// What must vanish: stresses of free faces, P11 - a in creep  [Pa].
Unknowns residual(Loading loading, double a, const Mat3& P) {
  Unknowns r(start(loading).size());
  if (loading == Loading::uniaxial) r << P(1, 1);
  if (loading == Loading::creep) r << P(0, 0) - a, P(1, 1);
  return r;
}

/// Derivative of f along each unknown by central differences.
template <class Function>
Eigen::MatrixXd jacobian(const Function& f, const Unknowns& q) {
  Eigen::MatrixXd K(q.size(), q.size());
  for (int j = 0; j < q.size(); ++j) {
    Unknowns up = q, down = q;
    up[j] += 1e-6;
    down[j] -= 1e-6;
    K.col(j) = (f(up) - f(down)) / 2e-6;
  }
  return K;
}

/// Newton's method with steps that keep every stretch positive.
template <class Function>
Unknowns solved(const Function& f, Unknowns q, double scale, double time) {
  if (q.size() == 0) return q;
  for (int i = 0; i < 60; ++i) {
    const Unknowns r = f(q);
    Unknowns step = -jacobian(f, q).fullPivLu().solve(r);
    const double largest = (step.array() / q.array()).abs().maxCoeff();
    if (largest > 0.3) step *= 0.3 / largest;
    q += step;
    // rounding of the stress leaves a few 1e-16 of its parts
    if (largest < 1e-13 || (largest < 1e-9 && r.norm() < 1e-12 * scale)) return q;
    if (!q.allFinite()) break;
  }
  throw base::BreakdownError(fmt::format(
      "no deformation satisfies the free faces at time {:g} s; use a smaller amplitude", time));
}

/// The point in motion.
class Walk {
 public:
  Walk(const MaterialPoint& material, const MaterialPath& path)
      : material_(material), path_(path), q_(start(path.loading)) {
    const double a = control(path, 0);
    const auto at = [&](const Unknowns& q) {
      return residual_of(0, material.virgin(deformation(path.loading, a, q)));
    };
    scale_ = std::max(
        1.0,
        material.acoustic_tensor(material.virgin(Mat3::Identity()), run::Vec3::UnitX()).norm());
    q_ = solved(at, q_, scale_, 0);
    state_ = material.virgin(deformation(path.loading, a, q_));
    rate_ = rate_of(state_, q_, 0);
  }

  /// @return what the branches have dissipated in it  [J/m^3]
  double step(double t, double dt) {
    const PointState before = state_;
    const Mat3 rate_before = rate_;
    const double a = control(path_, t + dt);
    // The rate at the end follows from the state there, which with GEXP follows from it.
    const int n_passes = path_.update == Update::gauss && q_.size() > 0 ? 4 : 1;
    if (q_.size() == 0) rate_ = rate_of(state_, q_, t + dt);
    for (int pass = 0; pass < n_passes; ++pass) {
      const auto after = [&](const Unknowns& q) {
        const Mat3 F = deformation(path_.loading, a, q);
        return PointState{F, path_.update == Update::gauss
                                 ? material_.relaxed_gauss(before, rate_before, F, rate_, dt)
                                 : material_.relaxed_linear(before, F, dt)};
      };
      q_ = solved([&](const Unknowns& q) { return residual_of(t + dt, after(q)); }, q_, scale_,
                  t + dt);
      state_ = after(q_);
      rate_ = rate_of(state_, q_, t + dt);
    }
    if (path_.update != Update::gauss) return material_.dissipation_of_step(before, state_, dt);
    return material_.dissipation_of_step(before, state_, dt, {{rate_before, rate_}});
  }

  const PointState& state() const { return state_; }

 private:
  Unknowns residual_of(double t, const PointState& state) const {
    return residual(path_.loading, control(path_, t), material_.stress(state));
  }

  /// Rate of F: that of the control, and of the unknowns so that the residual stays 0 while the
  /// branches relax: K q' = -dr/dt at fixed q.
  Mat3 rate_of(const PointState& state, const Unknowns& q, double t) const {
    const double a_rate = control_rate(path_, t), a = control(path_, t);
    const double dt_of_path = path_.end / path_.n_steps;
    // differences over a time in which neither the control nor a branch goes far
    double h = 1e-4 * dt_of_path;
    for (const run::PointBranch& b : material_.branch_rates(state)) {
      h = std::min(h, 1e-4 / std::max({algebra::to_eigen(b.A).norm(), algebra::to_eigen(b.S).norm(),
                                       1e-300}));
    }
    const auto moved = [&](double dt, const Unknowns& r) {
      PointState s = state;
      s.F = deformation(path_.loading, a + dt * a_rate, r);
      const auto rates = material_.branch_rates(state);
      for (size_t k = 0; k < rates.size(); ++k) {
        s.branches[k].A = s.branches[k].A + dt * rates[k].A;
        s.branches[k].S = s.branches[k].S + dt * rates[k].S;
      }
      return s;
    };
    Unknowns q_rate = Unknowns::Zero(q.size());
    if (q.size() > 0) {
      const auto at = [&](double dt, const Unknowns& r) {
        return residual(path_.loading, a + dt * a_rate, material_.stress(moved(dt, r)));
      };
      const Unknowns drift = (at(h, q) - at(-h, q)) / (2 * h);
      const Eigen::MatrixXd K = jacobian([&](const Unknowns& r) { return at(0, r); }, q);
      q_rate = -K.fullPivLu().solve(drift);
    }
    const double fastest = std::max(std::abs(a_rate), q.size() > 0 ? q_rate.norm() : 0);
    const double d = std::min(1e-4 * dt_of_path, 1e-4 / std::max(fastest, 1e-300));
    return (deformation(path_.loading, a + d * a_rate, q + d * q_rate) -
            deformation(path_.loading, a - d * a_rate, q - d * q_rate)) /
           (2 * d);
  }

  const MaterialPoint& material_;
  const MaterialPath& path_;
  Unknowns q_;
  PointState state_;
  Mat3 rate_;
  double scale_ = 1;
};

const char* name_of(Course course) {
  return course == Course::step ? "a step" : course == Course::ramp ? "a ramp" : "an oscillation";
}

/// Numbers that are none, and those that the path does not use.
void check_numbers(const MaterialPath& path) {
  for (const auto& [name, value] :
       {std::pair{"--amplitude", path.amplitude}, std::pair{"--rate", path.rate},
        std::pair{"--frequency", path.angular_frequency}, std::pair{"--end", path.end}}) {
    if (!std::isfinite(value))
      throw base::InputError(fmt::format("{} {} must be a finite number", name, value));
  }
  const auto refuse = [&](bool is_used, double value, const char* name) {
    if (is_used || value == 0) return;
    throw base::InputError(
        fmt::format("{} has no effect on {}; remove it", name, name_of(path.course)));
  };
  refuse(path.course == Course::ramp, path.rate, "--rate");
  refuse(path.course != Course::ramp, path.amplitude, "--amplitude");
  refuse(path.course == Course::oscillation, path.angular_frequency, "--frequency");
}

/// Enough steps for the moduli of the last cycle, where there is a whole one.
void check_cycle(const MaterialPath& path) {
  const double cycles = path.end * path.angular_frequency / (2 * pi);
  if (path.course != Course::oscillation || cycles < 1 - 1e-9) return;
  const double asked = steps_of_a_cycle(path.update), steps = path.n_steps / cycles;
  if (steps >= asked * (1 - 1e-9)) return;
  throw base::InputError(fmt::format(
      "--steps {} are {:.3g} a cycle, and its moduli need {:g}: give --steps {:.0f}, or a shorter "
      "--end",
      path.n_steps, steps, asked, std::ceil(asked * cycles * (1 - 1e-9))));
}

void check(const MaterialPath& path) {
  check_numbers(path);
  const auto need = [](bool given, const char* what, const char* why) {
    if (!given) throw base::InputError(fmt::format("{} is needed {}", what, why));
  };
  need(path.end > 0, "--end", "and must be above 0");
  need(path.n_steps >= 1, "--steps", "and must be 1 or more");
  need(path.n_steps <= 10'000'000, "--steps", "and must be 10000000 or less");
  if (path.course == Course::ramp) {
    need(path.rate != 0, "--rate", "for a ramp");
  } else {
    need(path.amplitude != 0, "--amplitude", "for a step or an oscillation");
  }
  if (path.course == Course::oscillation)
    need(path.angular_frequency > 0, "--frequency", "for an oscillation");
  const bool is_stretch = path.loading == Loading::confined || path.loading == Loading::uniaxial;
  const double least = path.course == Course::step   ? path.amplitude
                       : path.course == Course::ramp ? path.rate * path.end
                                                     : -std::abs(path.amplitude);
  if (is_stretch && least <= -1) {
    throw base::InputError(
        fmt::format("the path reaches the stretch 1 + a = {:g}; it must stay above 0", 1 + least));
  }
  check_cycle(path);
}

}  // namespace

void read_path_name(const std::string& name, MaterialPath& path) {
  struct Entry {
    Loading loading;
    Course course;
  };
  base::Registry<Entry> menu("path");
  for (const auto& [loading, first] :
       {std::pair{Loading::shear, "shear"}, std::pair{Loading::confined, "confined"},
        std::pair{Loading::uniaxial, "uniaxial"}, std::pair{Loading::creep, "creep"}}) {
    for (const auto& [course, second] :
         {std::pair{Course::step, "step"}, std::pair{Course::ramp, "ramp"},
          std::pair{Course::oscillation, "oscillation"}})
      menu.add(fmt::format("{}-{}", first, second), Entry{loading, course});
  }
  const Entry entry = menu.at(name);
  path.loading = entry.loading;
  path.course = entry.course;
}

double steps_of_a_cycle(Update update) {
  return update == Update::gauss ? 16 : 25;
}

std::vector<PathPoint> follow(const run::MaterialPoint& material, const MaterialPath& path) {
  check(path);
  Walk walk(material, path);
  std::vector<PathPoint> points;
  const double dt = path.end / path.n_steps;
  for (int n = 0; n <= path.n_steps; ++n) {
    const double t = n * dt;
    const double dissipated = n > 0 ? walk.step(t - dt, dt) : 0;
    PathPoint point;
    point.time = t;
    point.control = control(path, t);
    point.state = walk.state();
    point.P = material.stress(point.state);
    point.energy = material.energy(point.state);
    point.dissipation = material.dissipation(point.state);
    if (n > 0) {
      const PathPoint& before = points.back();
      point.work = before.work +
                   0.5 * (before.P + point.P).cwiseProduct(point.state.F - before.state.F).sum();
      point.dissipated = before.dissipated + dissipated;
    }
    points.push_back(std::move(point));
  }
  return points;
}

DynamicModuli dynamic_moduli(const std::vector<PathPoint>& points, const MaterialPath& path) {
  const double period = 2 * pi / path.angular_frequency;
  const double begin = path.end - period, dt = path.end / path.n_steps;
  if (path.course != Course::oscillation || begin < -1e-9 * period) {
    throw base::InputError("dynamic moduli need an oscillation of one period or more");
  }
  // P12 or P11 of an imposed strain; the strain of an imposed stress
  const auto response = [&](const PathPoint& point) {
    if (path.loading == Loading::creep) return point.state.F(0, 0) - 1;
    return point.P(0, path.loading == Loading::shear ? 1 : 0);
  };
  std::vector<const PathPoint*> cycle;  // without its first instant, which is the last one again
  for (const PathPoint& point : points) {
    if (point.time > begin + 1e-6 * dt) cycle.push_back(&point);
  }
  // Least squares of a mean and harmonics: whatever the phase at which the steps meet the cycle.
  constexpr int n_harmonics = 3;
  Eigen::MatrixXd waves(cycle.size(), 1 + 2 * n_harmonics);
  Eigen::VectorXd values(cycle.size());
  for (Eigen::Index n = 0; n < values.size(); ++n) {
    const PathPoint& point = *cycle[static_cast<size_t>(n)];
    const double phase = path.angular_frequency * point.time;
    waves(n, 0) = 1;
    for (int k = 1; k <= n_harmonics; ++k) {
      waves(n, 2 * k - 1) = std::sin(k * phase);
      waves(n, 2 * k) = std::cos(k * phase);
    }
    values[n] = response(point);
  }
  const Eigen::VectorXd fit = waves.colPivHouseholderQr().solve(values) / path.amplitude;
  if (path.loading != Loading::creep) return {fit[1], fit[2]};
  const double squares = fit[1] * fit[1] + fit[2] * fit[2];  // of the compliance
  return {fit[1] / squares, -fit[2] / squares};
}

HyperbolicityScan scan_hyperbolicity(const run::MaterialPoint& material,
                                     const std::vector<PathPoint>& points,
                                     int n_directions) {
  HyperbolicityScan scan;
  scan.n_states = static_cast<std::int64_t>(points.size());
  scan.n_directions = n_directions;
  scan.least = std::numeric_limits<double>::infinity();
  for (const PathPoint& point : points) {
    for (int k = 0; k < n_directions; ++k) {  // Fibonacci lattice on half the sphere
      const double z = (k + 0.5) / n_directions, angle = pi * (3 - std::sqrt(5.0)) * k;
      const double r = std::sqrt(1 - z * z);
      const run::Vec3 N(r * std::cos(angle), r * std::sin(angle), z);
      const Eigen::SelfAdjointEigenSolver<Mat3> solver(material.acoustic_tensor(point.state, N),
                                                       Eigen::EigenvaluesOnly);
      if (solver.eigenvalues()[0] < scan.least) {
        scan.least = solver.eigenvalues()[0];
        scan.time = point.time;
        scan.direction = N;
      }
    }
  }
  return scan;
}

}  // namespace diptych::harness
