/// The engine of manufactured solutions against tables that were made independently, against
/// differences, closed forms, and itself in another order of times.

#include "common/base/error.hpp"
#include "common/exact/manufactured/manufactured_solution.hpp"
#include "common/physics/materials/isochoric_neo_hookean.hpp"
#include "common/physics/materials/mooney_rivlin.hpp"
#include "tests/folders.hpp"

#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace diptych::exact {
namespace {

using physics::MaxwellBranch;
using physics::MooneyRivlin;

nlohmann::json reference(const std::string& file) {
  std::ifstream stream(tests::tests_folder() + "/reference/" + file);
  return nlohmann::json::parse(stream);  // throws where there is none
}

// Non-dimensional material of the tables: rho = mu = 1, lambda = 1.5, xi = zeta, one branch.
scheme::Model<MooneyRivlin> table_model() {
  return {MooneyRivlin{0.25, 0.25, 0.5}, 1.0, {{0.25, 0.3, 0.125, 0.3}}};
}

std::shared_ptr<const Motion> motion_of(const std::vector<std::string>& texts,
                                        const functions::Vocabulary& vocabulary = {}) {
  std::vector<ExpressionText> list;
  for (const std::string& text : texts)
    list.push_back({text, {}});
  return std::make_shared<Motion>(list, vocabulary);
}

/// The motion of the tables: their current position minus X.
std::shared_ptr<const Motion> table_motion(const nlohmann::json& single) {
  std::vector<std::string> u;
  for (const char* name : {"x", "y", "z"})
    u.push_back(fmt::format("({}) - {}", single.at("single").at(name).get<std::string>(), name));
  return motion_of(u);
}

Vec3 force_at(const KnownState& known, size_t node) {
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < known.body_forces().n_components(); ++i)
    f[i] = known.body_forces().at(static_cast<std::int64_t>(node), i);
  return f;
}

TEST(ManufacturedSolution, AgreesWithTheReferenceTable) {
  const auto rows = reference("mms_public_table.json").at("rows");
  ASSERT_EQ(rows.size(), 625U);
  const auto motion = table_motion(reference("mms_public_single.json"));
  double time = -1, worst = 0;
  std::vector<Vec3> X;
  for (const auto& row : rows) {
    if (row[0] == rows[0][0]) X.emplace_back(row[1], row[2], row[3]);
  }
  const auto known = manufactured_solution<3>(motion, table_model(), X, false, 1.0);
  scheme::Snapshot s;
  for (size_t r = 0; r < rows.size(); ++r) {
    const auto& row = rows[r];
    const size_t a = r % X.size();
    if (row[0] != time) s = known->snapshot(time = row[0]);
    ASSERT_EQ(X[a], Vec3(row[1], row[2], row[3]));
    worst = std::max({worst, (X[a] + s.u[a] - Vec3(row[4], row[5], row[6])).norm(),
                      (s.v[a] - Vec3(row[7], row[8], row[9])).norm(),
                      (force_at(*known, a) - Vec3(row[10], row[11], row[12])).norm(),
                      std::abs(s.J[a] - row[13].get<double>())});
  }
  EXPECT_LE(worst, 1e-11);  // forces up to 20, sixteen digits in the table
}

TEST(ManufacturedSolution, AgreesWithTheClosedFormOfTheReferenceForce) {
  const auto single = reference("mms_public_single.json");
  std::vector<Vec3> X;
  for (int k = 0; k < 40; ++k)
    X.emplace_back(std::fmod(0.618 * k, 1), std::fmod(0.414 * k, 1), std::fmod(0.732 * k, 1));
  const auto known = manufactured_solution<3>(table_motion(single), table_model(), X, false, 1.0);
  std::vector<std::string> f;
  // helpers by name, each a parenthesis in the next: the tape keeps common parts once
  for (const char* name : {"fx", "fy", "fz"})
    f.push_back(single.at("single").at(name).get<std::string>());
  const auto force = motion_of(f);  // a field of three smooth components
  for (const double t : {0.0, 0.137, 0.62, 0.91}) {
    known->move_to(t);
    for (size_t a = 0; a < X.size(); ++a) {
      const Vec3 expected = force->displacement(X[a], t);
      EXPECT_LE((force_at(*known, a) - expected).norm(), 1e-11 * (1 + expected.norm()))
          << X[a].transpose() << " at " << t;
    }
  }
}

const functions::Vocabulary vocabulary{{{"a", 0.45}, {"w", 3}}, {}};
const std::vector<std::string> swirl{"a*sin(w*t + 1)*x*cos(2*y) - 0.3*t*y*exp(-x^2)",
                                     "a*cos(w*t)*sin(y + x*z) + 0.2*t*x*z"};

template <int Dim, class Material>
void expect_balance_of_differences(const scheme::Model<Material>& model, bool relaxed) {
  std::vector<std::string> texts = swirl;
  if (Dim == 3) texts.push_back("a*sin(w*t)*x*y*cos(z)");
  if (Dim == 2) texts[1] = "a*cos(w*t)*sin(y + x) + 0.2*t*x";
  const auto motion = motion_of(texts, vocabulary);
  const Vec3 X(0.3, 0.4, Dim == 3 ? 0.6 : 0);
  const double step = 1e-3, t = 0.8;
  constexpr double weight[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  std::vector<Vec3> places{X};
  for (int j = 0; j < Dim; ++j) {
    for (int k = 1; k <= 4; ++k) {
      places.emplace_back(X + k * step * Vec3::Unit(j));
      places.emplace_back(X - k * step * Vec3::Unit(j));
    }
  }
  const auto known = manufactured_solution<Dim>(motion, model, places, relaxed, 1.0);
  known->move_to(t);
  Vec3 f = model.rho_R * motion->acceleration(X, t);
  Mat3 F = Mat3::Identity();
  const scheme::Snapshot s = known->snapshot(t);
  size_t a = 1;
  for (int j = 0; j < Dim; ++j) {
    for (int k = 1; k <= 4; ++k, a += 2) {
      f -= weight[k - 1] / step * (s.P[a].col(j) - s.P[a + 1].col(j));
      F.col(j) += weight[k - 1] / step * (s.u[a] - s.u[a + 1]);
    }
  }
  // eighth-order differences: rounding of P (about 10) over the step
  EXPECT_LE((force_at(*known, 0) - f).norm(), 1e-10);
  EXPECT_LE((s.F[0] - F).norm(), 1e-11);
  EXPECT_GT((F - Mat3::Identity()).norm(), 0.3) << "the strain is not large";
}

TEST(ManufacturedSolution, BodyForceClosesTheBalanceOfMomentum) {
  const std::vector<MaxwellBranch> branches{{0.3, 0.2, 0.1, 0.7}, {0.2, 1e-3, 0.3, 40}};
  for (const bool relaxed : {false, true}) {
    const scheme::Model<MooneyRivlin> mooney{{0.4, 0.2, 0.7}, 1.3, branches};
    expect_balance_of_differences<3>(mooney, relaxed);
    expect_balance_of_differences<2>(mooney, relaxed);
    const scheme::Model<physics::IsochoricNeoHookean> isochoric{{0.8, 1.9}, 1.3, {branches[0]}};
    expect_balance_of_differences<3>(isochoric, relaxed);
    const scheme::Model<physics::IsochoricNeoHookeanJ2> squared{{0.8, 1.9}, 1.3, {}};
    expect_balance_of_differences<2>(squared, relaxed);
  }
}

// Simple shear gamma = g t: C^-1 = [[1 + gamma^2, -gamma, 0], [-gamma, 1, 0], [0, 0, 1]] is
// quadratic in t, so A = B - tau B' + tau^2 B'' + (A_0 - B(0) + tau B'(0) - tau^2 B''(0))
// e^(-t/tau)
TEST(ManufacturedSolution, InternalVariablesAreExactForEveryRelaxationTime) {
  const double g = 0.9;
  const auto motion = motion_of({"g*t*y", "0*x"}, {{{"g", g}}, {}});
  for (const double tau : {1e-8, 1e-5, 1e-3, 0.03, 1.0, 50.0, 1e6}) {
    const scheme::Model<MooneyRivlin> model{{0.4, 0.2, 0.7}, 1.0, {{0.3, tau, 0.1, tau}}};
    const auto known = manufactured_solution<2>(motion, model, {Vec3(0.2, 0.4, 0)}, false, 1.0);
    for (const double t : {0.1, 0.2, 0.15, 0.2, 0.9, 1.0}) {
      const scheme::Snapshot s = known->snapshot(t);
      const auto particular = [&](double time) {
        Mat3 B = Mat3::Identity();
        B(0, 0) += g * g * (time * time - 2 * tau * time + 2 * tau * tau);
        B(0, 1) = B(1, 0) = -g * (time - tau);
        return B;
      };
      const Mat3 A = particular(t) + std::exp(-t / tau) * (Mat3::Identity() - particular(0));
      // tau^2 cancels for slow relaxation
      EXPECT_LE((s.A[0][0] - A).norm(), 1e-14 * (10 + tau * tau)) << tau << " at " << t;
    }
  }
}

TEST(ManufacturedSolution, OrderOfTheTimesDoesNotMatter) {
  const auto motion = motion_of({swirl[0], swirl[1], "0.1*t*z"}, vocabulary);
  const scheme::Model<MooneyRivlin> model{
      {0.4, 0.2, 0.7}, 1.0, {{0.3, 0.2, 0.1, 1e-4}, {0.1, 0.05, 0, 1}}};
  const std::vector<Vec3> X{{0.1, 0.2, 0.3}, {0.7, 0.9, 0.2}, {1, 0, 1}};
  const auto stepped = manufactured_solution<3>(motion, model, X, false, 1.0);
  const auto direct = manufactured_solution<3>(motion, model, X, false, 1.0);
  const double dt = 0.013;
  for (int step = 0; step < 70; ++step) {
    for (const double stage : {0.0, 1.0, 0.5})
      stepped->move_to((step + stage) * dt);
  }
  for (const double t : {70 * dt, 0.2, 0.0, 0.5}) {  // back to the start, too
    const scheme::Snapshot a = stepped->snapshot(t), b = direct->snapshot(t);
    for (size_t n = 0; n < X.size(); ++n) {
      EXPECT_LE((a.A[0][n] - b.A[0][n]).norm(), 1e-12);
      EXPECT_LE((a.S[0][n] - b.S[0][n]).norm(), 1e-12);
      EXPECT_LE((a.P[n] - b.P[n]).norm(), 1e-12);
      EXPECT_LE((force_at(*stepped, n) - force_at(*direct, n)).norm(),
                1e-11);  // gradients
    }
  }
}

// Intervals are as short as a jolt asks for, wherever in the run it is; a step that is made again
// asks for times before the last ones.
TEST(ManufacturedSolution, FollowsAJoltAndStepsThatAreMadeAgain) {
  const auto motion = motion_of({"0.1*tanh((t - 0.4003)/1e-3)*x", "0*x"}, vocabulary);
  const scheme::Model<MooneyRivlin> model{
      {0.4, 0.2, 0.7}, 1.0, {{0.3, 0.02, 0, 1}, {0, 1, 0.1, 0.5}}};
  const std::vector<Vec3> X{{0.1, 0.2, 0}, {0.7, 0.9, 0}};
  const auto stepped = manufactured_solution<2>(motion, model, X, false, 1.0);
  const auto direct = manufactured_solution<2>(motion, model, X, false, 1.0);
  const double dt = 2e-4;
  for (int step = 1950; step < 2050; ++step) {
    stepped->move_to(step * dt);
    for (const double share : {1.0, 0.5})
      stepped->move_to((step + share) * dt);
    if (step % 10 != 0) continue;
    for (const double share : {0.5, 0.25, 0.5, 1.1, 0.8})  // with half of it, and 0.6 after that
      stepped->move_to((step + share) * dt);
  }
  for (const double t : {2049.5 * dt, 2050 * dt, 0.7}) {
    const scheme::Snapshot a = stepped->snapshot(t), b = direct->snapshot(t);
    for (size_t n = 0; n < X.size(); ++n) {
      EXPECT_LE((a.A[0][n] - b.A[0][n]).norm(), 1e-12) << t;
      EXPECT_LE((a.S[1][n] - b.S[1][n]).norm(), 1e-12) << t;
      EXPECT_LE((force_at(*stepped, n) - force_at(*direct, n)).norm(), 1e-11) << t;
    }
  }
}

TEST(ManufacturedSolution, ReportsWhereTheMotionFails) {
  const scheme::Model<MooneyRivlin> model{{0.4, 0.2, 0.7}, 1.0, {}};
  const std::vector<Vec3> X{{0, 0, 0}, {0.5, 0, 0}};
  const auto inverted =
      manufactured_solution<3>(motion_of({"-t*x^2", "0", "0"}), model, X, false, 2);
  EXPECT_NO_THROW(inverted->move_to(0.9));
  try {
    inverted->move_to(1.5);
    FAIL() << "J < 0 went unnoticed";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("J = -0.5 at the node at (0.5, 0, 0), t = 1.5"));
  }
  EXPECT_THROW(manufactured_solution<3>(motion_of({"sqrt(x)", "0", "0"}), model, X, false, 2),
               base::InputError);
}

TEST(ExponentialGauss, IsExactForPolynomialsAndPositive) {
  for (const double z : {1e-8, 1e-3, 0.3, 2.0, 9.0, 70.0, 1e4, 1e8}) {
    const ExponentialGauss rule = exponential_gauss(4, z);
    // c_k = int_0^1 z e^(-z u) u^k du with u = 1 - theta, by the recurrence downwards from large k
    std::vector<double> c(200, 0);
    const double E = std::exp(-z);
    if (z < 50) {
      for (int k = 199; k > 0; --k)
        c[k - 1] = z / k * (c[k] + E);
    } else {
      c[0] = -std::expm1(-z);
      for (int k = 1; k < 8; ++k)
        c[k] = k / z * c[k - 1] - E;
    }
    for (int k = 0; k < 8; ++k) {
      double sum = 0;
      for (int i = 0; i < 4; ++i)
        sum += rule.weight[i] * std::pow(1 - rule.theta[i], k);
      // near the end of the interval 1 - theta keeps the digits of 1
      const double digits = 1e-13 + 1e-14 * z;
      EXPECT_NEAR(sum / c[k], 1, std::min(1.0, (k + 1) * digits)) << "z = " << z << ", k = " << k;
    }
    EXPECT_GT(*std::min_element(rule.weight.begin(), rule.weight.end()), 0);
    EXPECT_DOUBLE_EQ(rule.old, E);
  }
}

}  // namespace
}  // namespace diptych::exact
