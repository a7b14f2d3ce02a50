/// The formulas of a pair, eight at once, against the same formulas written out pair by pair:
/// every kind of dissipation, both forms of the force, both dimensions, doubles and singles.

#include "common/scheme/sweeps/pair_forces.hpp"

#include "common/scheme/sweeps/strain_sum.hpp"
#include "tests/common/scheme/sweeps/written_out.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace diptych {
namespace {

using algebra::Lanes;
using algebra::SingleLanes;
using algebra::Vec3;
using scheme::DissipationKind;
using scheme::Impedance;
using scheme::PairLimiter;
using scheme::Reconstruction;
using scheme::Stresses;
using tests::NodeOfPair;

/// Eight pairs of a table, as the sweeps read them.
template <class T_>
class EightPairs {
 public:
  using T = T_;
  explicit EightPairs(int n) : own_(static_cast<size_t>(n)), neighbour_(own_) {}
  T own(int c) const { return own_[static_cast<size_t>(c)]; }
  T neighbour(int c) const { return neighbour_[static_cast<size_t>(c)]; }
  void set(int c, int lane, double own, double neighbour) {
    own_[static_cast<size_t>(c)][lane] = static_cast<algebra::Element<T>>(own);
    neighbour_[static_cast<size_t>(c)][lane] = static_cast<algebra::Element<T>>(neighbour);
  }

 private:
  std::vector<T> own_, neighbour_;
};

/// A body of one pair, for what a sweep asks of its body.
template <int Dim>
scheme::Body<Dim> body_of_one_pair(double rho_R) {
  scheme::PairGraph graph;
  graph.dimension = Dim;
  graph.X = {Vec3::Zero(), Vec3::UnitX()};
  graph.Omega = {1, 1};
  graph.boundary_area.assign(2, Vec3::Zero());
  graph.row = {0, 1, 2};
  graph.neighbour = {1, 0};
  graph.reverse_place = {0, 0};
  graph.C.each() = {Vec3::UnitX(), -Vec3::UnitX()};
  scheme::BodyOptions options;
  options.rho_R = rho_R;
  return scheme::Body<Dim>(graph, options, scheme::Arrangement::rows);
}

/// Eight random pairs; the last lane of the padding, without area.
template <int Dim, class T>
struct RandomPairs {
  static constexpr int n_lanes = algebra::n_lanes;
  std::array<NodeOfPair, n_lanes> a, b;
  std::array<Vec3, n_lanes> C_ab, C_ba;
  EightPairs<T> records{scheme::NodeRecord<Dim>::n_exact}, positions{Dim}, velocities{Dim},
      frames{scheme::NodeFrame<Dim>::n};
  scheme::PairGeometry<Dim, T> geometry;

  RandomPairs(unsigned seed, bool has_H) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int lane = 0; lane < n_lanes; ++lane) {
      const auto k = static_cast<size_t>(lane);
      const auto pair = tests::random_pair<Dim>(random, has_H, seed % 2 == 0 ? 1 : 0.02);
      a[k] = pair[0];
      b[k] = pair[1];
      C_ab[k] = C_ba[k] = Vec3::Zero();
      for (int i = 0; i < Dim; ++i) {
        C_ab[k][i] = uniform(random);
        C_ba[k][i] = uniform(random);
      }
      if (lane == n_lanes - 1) C_ab[k] = C_ba[k] = Vec3::Zero();
      put(lane, k);
    }
  }

 private:
  void put(int lane, size_t k) {
    using Real = algebra::Element<T>;
    std::vector<double> own(scheme::NodeRecord<Dim>::n_exact);
    tests::put_record<Dim>(a[k], true, [&](int c, double value) { own[size_t(c)] = value; });
    tests::put_record<Dim>(
        b[k], true, [&](int c, double value) { records.set(c, lane, own[size_t(c)], value); });
    std::vector<double> own_frame(scheme::NodeFrame<Dim>::n);
    tests::put_frame<Dim>(a[k], [&](int c, double value) { own_frame[size_t(c)] = value; });
    tests::put_frame<Dim>(
        b[k], [&](int c, double value) { frames.set(c, lane, own_frame[size_t(c)], value); });
    const Vec3 S = (C_ab[k] - C_ba[k]) / 2;
    for (int i = 0; i < Dim; ++i) {
      positions.set(i, lane, a[k].X[i], b[k].X[i]);
      velocities.set(i, lane, a[k].v[i], b[k].v[i]);
      geometry.C_ab[i][lane] = static_cast<Real>(C_ab[k][i]);
      geometry.C_ba[i][lane] = static_cast<Real>(C_ba[k][i]);
      geometry.S[i][lane] = static_cast<Real>(3 * S[i]);  // its length is free
    }
    geometry.area[lane] = static_cast<Real>(S.norm());
  }
};

constexpr Reconstruction linear = Reconstruction::linear;
constexpr DissipationKind plain{Reconstruction::none, PairLimiter::none, Impedance::isotropic};
constexpr DissipationKind isotropic{linear, PairLimiter::none, Impedance::isotropic};
constexpr DissipationKind sign_preserving{linear, PairLimiter::sign_preserving,
                                          Impedance::isotropic};
constexpr DissipationKind barth_jespersen{linear, PairLimiter::barth_jespersen,
                                          Impedance::isotropic};
constexpr DissipationKind venkatakrishnan{linear, PairLimiter::venkatakrishnan,
                                          Impedance::isotropic};
constexpr DissipationKind exact{linear, PairLimiter::none, Impedance::exact};

constexpr DissipationKind objective{Reconstruction::objective, PairLimiter::none,
                                    Impedance::isotropic};
constexpr DissipationKind limited_objective{Reconstruction::objective, PairLimiter::sign_preserving,
                                            Impedance::isotropic};

/// Compares the forces of many random pairs of one kind.
template <int Dim, DissipationKind kind, bool has_H, Stresses which, class T>
void compare() {
  const double rho_R = 1.3, factor = 0.7;
  scheme::Body<Dim> body = body_of_one_pair<Dim>(rho_R);
  const scheme::MomentumSweep<Dim> sweep{body, factor, false, nullptr, nullptr, nullptr};
  // values of order one to ten; singles: some ten roundings of 6e-8
  const double bound = std::is_same_v<T, Lanes> ? 1e-13 : 1e-5;
  int n_limited = 0, n_compared = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const RandomPairs<Dim, T> random(seed, has_H);
    const auto jump = scheme::plain_jump<Dim>(random.velocities, 0);
    const auto f = scheme::pair_forces<Dim, kind, has_H, which>(
        sweep, random.geometry, random.records, random.positions, random.frames, jump);
    for (int lane = 0; lane < algebra::n_lanes; ++lane) {
      const auto k = static_cast<size_t>(lane);
      const NodeOfPair &a = random.a[k], &b = random.b[k];
      const auto pair = tests::pair_written_out(kind, rho_R, a, b, random.C_ab[k], random.C_ba[k]);
      if (pair.at_switch) continue;
      Vec3 force = 2 * factor * pair.D - b.P * random.C_ba[k];
      if (which == Stresses::both) force += a.P * random.C_ab[k];
      for (int i = 0; i < Dim; ++i)
        ASSERT_NEAR(f.force[i][lane], force[i], bound * (1 + 10 * force.norm()))
            << Dim << "-D, seed " << seed << ", lane " << lane;
      ASSERT_NEAR(f.power[lane], 2 * factor * pair.power, 30 * bound);
      if constexpr (kind.limiter != PairLimiter::none) {
        ASSERT_EQ(f.limited[lane], pair.is_limited ? 1 : 0) << "seed " << seed << ", lane " << lane;
        n_limited += pair.is_limited;
      }
      ++n_compared;
    }
  }
  EXPECT_GE(n_compared, 140);  // of 160: most at no switch
  if constexpr (kind.limiter != PairLimiter::none) {
    EXPECT_GT(n_limited, 10);
    EXPECT_LT(n_limited, 20 * 7);
  }
}

TEST(PairForces, AreThoseOfTheEquationsInDoubles) {
  compare<3, plain, true, Stresses::both, Lanes>();
  compare<3, isotropic, true, Stresses::both, Lanes>();
  compare<3, isotropic, true, Stresses::of_neighbour, Lanes>();
  compare<2, isotropic, true, Stresses::both, Lanes>();
}

TEST(PairForces, AreThoseOfTheEquationsInSingles) {
  compare<3, isotropic, true, Stresses::both, SingleLanes>();
  compare<3, venkatakrishnan, true, Stresses::both, SingleLanes>();
}

TEST(PairForces, OfLimitedJumpsAreThoseOfTheEquations) {
  compare<3, sign_preserving, true, Stresses::both, Lanes>();
  compare<2, sign_preserving, true, Stresses::both, Lanes>();
  compare<3, barth_jespersen, true, Stresses::both, Lanes>();
  compare<2, barth_jespersen, true, Stresses::both, Lanes>();
  compare<3, venkatakrishnan, true, Stresses::both, Lanes>();
}

TEST(PairForces, OfObjectiveJumpsAreThoseOfTheEquations) {
  compare<3, objective, true, Stresses::both, Lanes>();
  compare<3, objective, true, Stresses::of_neighbour, SingleLanes>();
  compare<2, objective, true, Stresses::both, Lanes>();
  compare<3, limited_objective, true, Stresses::both, Lanes>();
  compare<2, limited_objective, true, Stresses::both, Lanes>();
}

TEST(PairForces, OfTheExactImpedanceAreThoseOfTheEquations) {
  compare<3, exact, true, Stresses::both, Lanes>();
  compare<3, exact, false, Stresses::both, Lanes>();
  compare<2, exact, true, Stresses::both, Lanes>();
  compare<2, exact, false, Stresses::both, Lanes>();
}

TEST(PairForces, RateIsAreaTimesTheLargerImpedance) {
  const RandomPairs<3, Lanes> random(1, true);
  const Lanes rate = scheme::rate_of<3, Lanes>(random.geometry.C_ab, random.records);
  for (size_t k = 0; k < 8; ++k) {
    const double z = std::max(random.a[k].z_p, random.b[k].z_p);
    EXPECT_NEAR(rate[static_cast<int>(k)], random.C_ab[k].norm() * z, 1e-14);
  }
}

/// Two chunks of eight pairs.
TEST(StrainSum, IsThatOfTheEquation) {
  const RandomPairs<3, Lanes> random[2] = {{1, true}, {2, true}};
  struct Cursor {
    const RandomPairs<3, Lanes>* now;
    void next(Lanes (&C_ab)[3]) {
      for (int i = 0; i < 3; ++i)
        C_ab[i] = now->geometry.C_ab[i];
      ++now;
    }
  };
  Lanes sum[9];
  scheme::sum_gradients<3>(
      2, Cursor{random}, [&](std::int64_t k) { return random[k].velocities; }, sum);
  for (size_t lane = 0; lane < 8; ++lane) {
    algebra::Mat3 whole = algebra::Mat3::Zero();
    for (const auto& pairs : random)
      whole += (pairs.b[lane].v - pairs.a[lane].v) * pairs.C_ab[lane].transpose();
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(sum[k][static_cast<int>(lane)], whole(k / 3, k % 3), 1e-14);
  }
}

}  // namespace
}  // namespace diptych
