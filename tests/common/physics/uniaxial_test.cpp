/// Uniaxial relaxation and creep with free lateral faces: the small system of internal variables
/// and algebraic conditions, solved with the library's stress and relaxation, against tabulated
/// numbers.

#include "tests/common/physics/reference_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace diptych::tests {
namespace {

using physics::deformation_of;

/// E = 17 MPa, xi = zeta, beta_C = beta_G = 1, tau_C = tau_G = tau.
Body<physics::MooneyRivlin> material(double nu, double tau) {
  const auto p = physics::mooney_rivlin_parameters(physics::lame_from_young(17e6, nu), 0.5);
  return {{p.xi, p.zeta, p.lambda_hat}, {{p.xi, tau, p.zeta, tau}}, {virgin()}};
}
Tensor<double> stretches(double axial, double lateral) {
  return {{{axial, 0, 0}, {0, lateral, 0}, {0, 0, lateral}}};
}

/// Root of an increasing function between low and high, to the last digit.
double root(const std::function<double(double)>& f, double low, double high) {
  EXPECT_LT(f(low), 0);
  EXPECT_GT(f(high), 0);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Lateral stretch for P_22 = 0 at a given axial stretch and given internal variables.
double lateral_stretch(const Body<physics::MooneyRivlin>& body, double axial) {
  return root([&](double lateral) { return body.piola(stretches(axial, lateral))(1, 1); }, 0.3, 2);
}
double axial_stress(const Body<physics::MooneyRivlin>& body, double axial) {
  return body.piola(stretches(axial, lateral_stretch(body, axial)))(0, 0);
}

/// State variables of one path: axial stretch and internal variables.
struct Path {
  Body<physics::MooneyRivlin> body;
  double axial;
};

/// Advances by (LIN) over dt; `axial_of(body)` answers the axial stretch at the end of the step for
/// given internal variables. Both unknowns depend on each other: fixed-point iteration.
template <class AxialOf>
void advance(Path& path, double dt, AxialOf axial_of) {
  auto& body = path.body;
  const auto w = physics::linear_relaxation(dt / body.branches[0].tau_C);
  const auto old = body.states[0];
  const auto begin = deformation_of(stretches(path.axial, lateral_stretch(body, path.axial)));
  double axial = axial_of(body);
  for (int k = 0; k < 12; ++k) {  // contracts by about dt/tau each time
    const auto end = deformation_of(stretches(axial, lateral_stretch(body, axial)));
    body.states[0] = {
        physics::relaxed(w, old.A, physics::inverse_C(begin), physics::inverse_C(end)),
        physics::relaxed(w, old.S, physics::inverse_G(begin), physics::inverse_G(end))};
    axial = axial_of(body);
  }
  path.axial = axial;
}

/// Richardson's extrapolation of a second-order result from n and 2 n steps.
double extrapolated(const std::function<double(int)>& result, int n) {
  return (4 * result(2 * n) - result(n)) / 3;
}

TEST(UniaxialRelaxation, HasTheTabulatedStress) {
  const double stretch = 1.5, tau = 1;
  EXPECT_NEAR(axial_stress(material(0.45, tau), stretch) / 1.03034159e7, 1, 1e-8);
  const auto stress_at_tau = [&](int n) {
    Path path = {material(0.45, tau), stretch};
    for (int k = 0; k < n; ++k)
      advance(path, tau / n, [&](const auto&) { return stretch; });
    return axial_stress(path.body, stretch);
  };
  // nine digits are tabulated; the extrapolation is off by (1/60)^4 of a relative change of 0.3
  EXPECT_NEAR(extrapolated(stress_at_tau, 30) / 7.05549577e6, 1, 1e-8);
}

TEST(UniaxialCreep, HasTheTabulatedStretch) {
  const double load = 3e6, tau = 1;
  const auto axial_of = [&](const Body<physics::MooneyRivlin>& body) {
    return root([&](double axial) { return axial_stress(body, axial) - load; }, 0.9, 1.6);
  };
  EXPECT_NEAR(axial_of(material(0.45, tau)), 1.10184049, 1e-8);
  const auto stretch_at_tau = [&](int n) {
    Path path = {material(0.45, tau), axial_of(material(0.45, tau))};
    for (int k = 0; k < n; ++k)
      advance(path, tau / n, axial_of);
    return path.axial;
  };
  EXPECT_NEAR(extrapolated(stretch_at_tau, 10), 1.14781600, 2e-8);
}

TEST(UniaxialTraction, FollowsTheReferenceRamp) {
  // stretch 1 + 10 t up to 2 at t = 0.1, then held; nu = 0.3, tau = 0.1
  const auto table = reference_table("ref1_uniax_free.json");
  const auto run = [&](double t_end, int n) {
    Path path = {material(0.3, 0.1), 1};
    const auto go = [&](double from, double to, int steps) {
      for (int k = 1; k <= steps; ++k) {
        const double t = from + (to - from) * k / steps;
        advance(path, (to - from) / steps, [&](const auto&) { return 1 + 10 * std::min(t, 0.1); });
      }
    };
    go(0, std::min(t_end, 0.1), n);  // a step ends at the kink
    if (t_end > 0.1) go(0.1, t_end, n);
    return path;
  };
  for (const auto& row : table.at("result")) {
    const double t = row.at("t"), lateral = row.at("lateral"), P_11 = matrix(row.at("P"))(0, 0);
    if (t == 0) continue;
    const auto stress = [&](int n) {
      const auto path = run(t, n);
      return axial_stress(path.body, path.axial);
    };
    const auto width = [&](int n) {
      const auto path = run(t, n);
      return lateral_stretch(path.body, path.axial);
    };
    EXPECT_NEAR(extrapolated(width, 20), lateral, 1e-7) << t;
    EXPECT_NEAR(extrapolated(stress, 20) / P_11, 1, 1e-6) << t;
  }
}

}  // namespace
}  // namespace diptych::tests
