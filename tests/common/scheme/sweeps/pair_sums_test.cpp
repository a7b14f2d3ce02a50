/// The sweeps over a whole body, of rows and of runs, in doubles and in singles, against sums that
/// are written out pair by pair from the graph: forces, numerical dissipation, step bound, limited
/// pairs (18a); strain rates (18b); slopes along lines; both sides of the face correction. The
/// areas of the graph are random, so that nothing cancels.

#include "common/scheme/sweeps/compiled/momentum.hpp"
#include "common/scheme/sweeps/face_correction.hpp"
#include "common/scheme/sweeps/strain_sum.hpp"
#include "tests/common/scheme/sweeps/written_out.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace diptych {
namespace {

using algebra::Lanes;
using algebra::Mat3;
using algebra::Vec3;
using scheme::Arrangement;
using scheme::DissipationKind;
using scheme::Impedance;
using scheme::PairLimiter;
using scheme::Precision;
using scheme::Reconstruction;
using tests::NodeOfPair;

#if defined(DIPTYCH_ONLY_AVX512)
constexpr auto isa = algebra::InstructionSet::avx512;
#elif defined(DIPTYCH_ONLY_AVX2)
constexpr auto isa = algebra::InstructionSet::avx2;
#else
constexpr auto isa = algebra::InstructionSet::baseline;
#endif

/// Random areas for given pairs.
/// @param neighbours  of each node, ascending
scheme::PairGraph random_graph(std::vector<Vec3> X,
                               const std::vector<std::vector<std::int32_t>>& neighbours,
                               Precision precision) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  scheme::PairGraph graph;
  graph.X = std::move(X);
  graph.row = {0};
  for (const auto& row : neighbours) {
    graph.Omega.push_back(1 + 0.3 * uniform(random));
    for (const std::int32_t b : row) {
      graph.neighbour.push_back(b);
      graph.C.each().emplace_back(uniform(random), uniform(random), uniform(random));
    }
    graph.row.push_back(graph.n_pairs());
  }
  graph.boundary_area.assign(graph.X.size(), Vec3::Zero());
  scheme::link_reverse_pairs(graph);
  scheme::set_precision(graph, precision);
  return graph;
}

/// 56 x 3 x 3 nodes, each with the 26 around it: the seven blocks of a line have their pairs at the
/// same offsets, so that four and three are worked together, of three in singles two and one.
scheme::PairGraph random_lattice(Precision precision) {
  constexpr int n[3] = {56, 3, 3};
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  std::vector<Vec3> X;
  std::vector<std::vector<std::int32_t>> neighbours;
  const auto is_inside = [&](const std::array<int, 3>& at) {
    return at[0] >= 0 && at[0] < n[0] && at[1] >= 0 && at[1] < n[1] && at[2] >= 0 && at[2] < n[2];
  };
  for (int a = 0; a < n[0] * n[1] * n[2]; ++a) {
    const std::array<int, 3> at = {a % n[0], a / n[0] % n[1], a / n[0] / n[1]};
    X.emplace_back(at[0] + uniform(random), at[1], at[2] + uniform(random));
    neighbours.emplace_back();
    for (int k = 0; k < 27; ++k) {
      const std::array<int, 3> other = {at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1,
                                        at[2] + k / 9 - 1};
      if (k != 13 && is_inside(other))
        neighbours.back().push_back((other[2] * n[1] + other[1]) * n[0] + other[0]);
    }
  }
  return random_graph(std::move(X), neighbours, precision);
}

/// Nodes on a line whose first block has its pairs at the offset 8, the second at 9: offsets that
/// follow each other without belonging together.
scheme::PairGraph two_offsets() {
  std::vector<Vec3> X;
  std::vector<std::vector<std::int32_t>> neighbours(25);
  for (std::int32_t a = 0; a < 25; ++a)
    X.emplace_back(a, 0.1 * (a % 3), 0);
  for (std::int32_t a = 0; a < 16; ++a) {
    const std::int32_t b = a + (a < 8 ? 8 : 9);
    neighbours[static_cast<size_t>(a)].push_back(b);
    neighbours[static_cast<size_t>(b)].insert(neighbours[static_cast<size_t>(b)].begin(), a);
  }
  return random_graph(std::move(X), neighbours, Precision::full);
}

/// Nodes on a line of which the first eight have no pairs and the next eight one each: a block with
/// pairs behind one without.
scheme::PairGraph empty_first_block() {
  std::vector<Vec3> X;
  std::vector<std::vector<std::int32_t>> neighbours(24);
  for (std::int32_t a = 0; a < 24; ++a)
    X.emplace_back(a, 0.1 * (a % 3), 0);
  for (std::int32_t a = 8; a < 16; ++a) {
    neighbours[static_cast<size_t>(a)].push_back(a + 8);
    neighbours[static_cast<size_t>(a + 8)].push_back(a);
  }
  return random_graph(std::move(X), neighbours, Precision::full);
}

/// A body with random records; `nodes` are what its tables hold, rounded where they are singles.
class RandomBody {
 public:
  RandomBody(scheme::PairGraph of, Arrangement arrangement, bool exact = false)
      : graph(std::move(of)), body(graph, options_of(graph, exact), arrangement) {
    std::mt19937 random(9);
    while (nodes.size() < graph.X.size()) {
      for (NodeOfPair& node : tests::random_pair<3>(random, true, 1))
        nodes.push_back(node);
    }
    nodes.resize(graph.X.size());
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a)
      put(a, exact);
  }
  scheme::PairGraph graph;
  scheme::Body<3> body;
  std::vector<NodeOfPair> nodes;

 private:
  static scheme::BodyOptions options_of(const scheme::PairGraph& graph, bool exact) {
    scheme::BodyOptions options;
    options.rho_R = 1.3;
    options.has_slopes = !graph.slopes.empty();
    options.exact_impedance = exact;
    return options;
  }
  void put(std::int64_t a, bool exact) {
    using Record = scheme::NodeRecord<3>;
    NodeOfPair& node = nodes[static_cast<size_t>(a)];
    tests::put_record<3>(node, exact, [&](int c, double value) { body.records.set(a, c, value); });
    const auto stored = [&](int c) { return body.records.at(a, c); };
    for (int i = 0; i < 3; ++i) {
      body.v.set(a, i, node.v[i]);
      node.v[i] = body.v.at(a, i);
      node.X[i] = body.graph.X.at(a, i);
      if (!body.in_runs()) body.records.set(a, Record::v(exact) + i, node.v[i]);
      for (int j = 0; j < 3; ++j) {
        node.P(i, j) = stored(Record::P + i * 3 + j);
        node.L(i, j) = stored(Record::L + i * 3 + j);
        node.H(i, j) = stored(Record::H + i * 3 + j) + (i == j ? 1 : 0);
      }
    }
    node.z_p = stored(Record::z_p);
    node.z_s = stored(Record::z_s);
  }
};

/// For every pair of a body: use(a, b, C_ab, C_ba).
template <class Use>
void for_pairs(const RandomBody& random, const Use& use) {
  const scheme::PairGraph& graph = random.graph;
  for (size_t a = 0; a < random.nodes.size(); ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const auto k = static_cast<size_t>(p);
      use(a, static_cast<size_t>(graph.neighbour[k]), graph.C[k], graph.C[graph.reverse(k)]);
    }
  }
}

class Arrangements : public testing::TestWithParam<Arrangement> {};
INSTANTIATE_TEST_SUITE_P(Both, Arrangements, testing::Values(Arrangement::rows, Arrangement::runs));

/// Of a pair whose area points from a to b; others dissipate nothing (dissipation_area.hpp).
tests::PairWrittenOut dissipation_of_pair(const DissipationKind& kind,
                                          const NodeOfPair& a,
                                          const NodeOfPair& b,
                                          const Vec3& C_ab,
                                          const Vec3& C_ba) {
  if ((C_ab - C_ba).dot(b.X - a.X) <= 0) return {};
  return tests::pair_written_out(kind, 1.3, a, b, C_ab, C_ba);
}

/// The sweep over blocks [begin, end), range after range of n at most: each works its own blocks
/// alone, whatever the offsets of the next one.
template <DissipationKind kind, class Real>
void forces_by_ranges(const scheme::MomentumSweep<3>& sweep,
                      std::int64_t begin,
                      std::int64_t end,
                      std::int64_t chunk,
                      std::int64_t n) {
  for (; begin < end; begin += n) {
    double power = 0, rate = 0, limited = 0;
    scheme::ForcesOfBlocks<3, kind, true>::template run<isa, Real>(
        {sweep.body, sweep.factor, sweep.with_bound, &power, &rate, &limited}, begin,
        std::min(begin + n, end), 0);
    sweep.numerical_power[chunk] += power;
    sweep.largest_rate[chunk] = std::max(sweep.largest_rate[chunk], rate);
    sweep.limited_pairs[chunk] += limited;
  }
}

/// One momentum sweep against its sums.
/// @param n_blocks  of a range at most
template <DissipationKind kind, class Real, std::int64_t n_blocks = 1000>
void compare_forces(const scheme::PairGraph& graph, Arrangement arrangement, double bound) {
  constexpr bool exact = kind.impedance == Impedance::exact;
  constexpr bool is_single = std::is_same_v<Real, float>;
  RandomBody random(graph, arrangement, exact);
  const double factor = 0.7;
  std::vector<double> power(8), rate(8), limited(8);
  scheme::sum_forces<3>(
      {random.body, factor, true, power.data(), rate.data(), limited.data()},
      [](const scheme::MomentumSweep<3>& sweep, std::int64_t begin, std::int64_t end,
         std::int64_t chunk) { forces_by_ranges<kind, Real>(sweep, begin, end, chunk, n_blocks); });
  std::vector<Vec3> T(random.nodes.size(), Vec3::Zero());
  std::vector<double> rates(T.size());
  double numerical = 0, dissipated = 0, n_limited = 0, size = 0;
  for_pairs(random, [&](size_t a, size_t b, const Vec3& C_ab, const Vec3& C_ba) {
    const NodeOfPair &one = random.nodes[a], &other = random.nodes[b];
    const auto pair = dissipation_of_pair(kind, one, other, C_ab, C_ba);
    T[a] += (one.P * C_ab - other.P * C_ba) / 2 + factor * pair.D;
    numerical += factor * pair.power / 2;  // of each pair twice
    dissipated += std::abs(factor * pair.power / 2);
    n_limited += pair.is_limited ? 0.5 : 0;
    rates[a] += C_ab.norm() * std::max(one.z_p, other.z_p) / (2 * 1.3 * random.graph.Omega[a]);
  });
  for (size_t a = 0; a < T.size(); ++a)
    size = std::max(size, T[a].norm());
  for (size_t a = 0; a < T.size(); ++a) {
    for (int i = 0; i < 3; ++i)
      ASSERT_NEAR(random.body.T.at(static_cast<std::int64_t>(a), i), T[a][i], bound * size)
          << "node " << a;
  }
  EXPECT_NEAR(std::accumulate(power.begin(), power.end(), 0.0), numerical, bound * dissipated);
  const double largest = *std::max_element(rates.begin(), rates.end());
  EXPECT_NEAR(*std::max_element(rate.begin(), rate.end()), largest, 1e-6 * largest);
  const double counted = std::accumulate(limited.begin(), limited.end(), 0.0);
  EXPECT_NEAR(counted, n_limited, is_single ? 2 : 0);  // just limited or just not
}

constexpr DissipationKind isotropic{};
constexpr DissipationKind sign_preserving{Reconstruction::linear, PairLimiter::sign_preserving,
                                          Impedance::isotropic};

// In rows S_ab and |S_ab|, which scale D_ab, are singles; in runs |S_ab|.
TEST_P(Arrangements, ForcesAreSumsOverPairs) {
  const scheme::PairGraph lattice = random_lattice(Precision::full);
  compare_forces<isotropic, double>(lattice, GetParam(), 3e-7);
  compare_forces<sign_preserving, double>(lattice, GetParam(), 3e-7);
  compare_forces<isotropic, double>(two_offsets(), GetParam(), 3e-7);
  compare_forces<isotropic, double>(empty_first_block(), GetParam(), 3e-7);
  compare_forces<isotropic, double, 6>(lattice, GetParam(), 3e-7);
}
TEST_P(Arrangements, ForcesAreSumsOverPairsInSingles) {
  const scheme::PairGraph lattice = random_lattice(Precision::single);
  compare_forces<isotropic, float>(lattice, GetParam(), 3e-6);
  compare_forces<sign_preserving, float>(lattice, GetParam(), 3e-6);
  compare_forces<isotropic, float, 5>(lattice, GetParam(), 3e-6);
}

/// dF/dt of all nodes, in steps of one or two blocks.
TEST_P(Arrangements, StrainRatesAreSumsOverPairs) {
  for (const Precision precision : {Precision::full, Precision::single}) {
    const RandomBody random(random_lattice(precision), GetParam());
    std::vector<Mat3> rates(random.nodes.size(), Mat3::Zero());
    for_pairs(random, [&](size_t a, size_t b, const Vec3& C_ab, const Vec3&) {
      rates[a] +=
          (random.nodes[b].v - random.nodes[a].v) * C_ab.transpose() / (2 * random.graph.Omega[a]);
    });
    int n_twos = 0;
    for (std::int64_t b = 0; b < random.body.n_blocks;) {
      Lanes L[2][9];
      const int n = scheme::strain_rates_of_next<isa>(random.body, b, random.body.n_blocks, L);
      n_twos += n == 2;
      for (int k = 0; k < 9; ++k) {
        for (std::int64_t i = 0; i < 8 * n; ++i) {
          const auto a = static_cast<size_t>(b * 8 + i);
          if (a >= rates.size()) break;
          // 26 pairs of order one
          ASSERT_NEAR(L[i / 8][k][i % 8], rates[a](k / 3, k % 3),
                      precision == Precision::full ? 1e-13 : 1e-5);
        }
      }
      b += n;
    }
    EXPECT_EQ(n_twos > 0, precision == Precision::single && GetParam() == Arrangement::runs);
  }
}

/// Slopes of every node over up to four others of its line, with weights of its own.
scheme::SlopeRows random_slopes(const scheme::PairGraph& graph) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  scheme::SlopeRows slopes;
  slopes.row = {0};
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    for (const std::int64_t b : {a - 2, a - 1, a + 1, a + 2}) {
      if (b < 0 || b >= graph.n_nodes()) continue;
      slopes.neighbour.push_back(static_cast<std::int32_t>(b));
      slopes.weight.each().emplace_back(uniform(random), uniform(random), uniform(random));
    }
    slopes.row.push_back(static_cast<std::int64_t>(slopes.neighbour.size()));
  }
  return slopes;
}

TEST_P(Arrangements, SlopesAlongLinesAreSumsOverTheirRows) {
  for (const Precision precision : {Precision::full, Precision::single}) {
    scheme::PairGraph graph = random_lattice(precision);
    graph.slopes = random_slopes(graph);
    const RandomBody random(std::move(graph), GetParam());
    const scheme::SlopeRows& rows = random.graph.slopes;
    for (std::int64_t b = 0; b < random.body.n_blocks; ++b) {
      Lanes slopes[9];
      scheme::slopes_of_block<isa>(random.body, b, slopes);
      for (std::int64_t a = b * 8; a < std::min<std::int64_t>(random.graph.n_nodes(), b * 8 + 8);
           ++a) {
        const auto node = static_cast<size_t>(a);
        Mat3 slope = Mat3::Zero();
        for (auto p = static_cast<size_t>(rows.row[node]);
             p < static_cast<size_t>(rows.row[node + 1]); ++p) {
          const auto other = static_cast<size_t>(rows.neighbour[p]);
          slope += (random.nodes[other].v - random.nodes[node].v) * rows.weight[p].transpose();
        }
        for (int k = 0; k < 9; ++k)
          ASSERT_NEAR(slopes[k][a % 8], slope(k / 3, k % 3),
                      precision == Precision::full ? 1e-14 : 2e-6)
              << "node " << a;
      }
    }
  }
}

/// Q_a + kappa_f/Omega_a sum_b [(Q_a - Q_b) x] (x) y with x, y = X_ab, S_ab for rates, S_ab, X_ab
/// for stresses.
template <scheme::Side side>
void compare_correction(Arrangement arrangement, Precision precision) {
  const RandomBody random(random_lattice(precision), arrangement);
  const double kappa_f = 1.0 / 6;
  algebra::NodeTable tensors(random.graph.n_nodes(), 9, scheme::tensor_stride<3>,
                             random.body.graph.shape);
  std::vector<Mat3> corrected(random.nodes.size());
  for (size_t a = 0; a < corrected.size(); ++a) {
    corrected[a] = random.nodes[a].P;
    for (int k = 0; k < 9; ++k)
      tensors.set(static_cast<std::int64_t>(a), k, corrected[a](k / 3, k % 3));
  }
  for_pairs(random, [&](size_t a, size_t b, const Vec3& C_ab, const Vec3& C_ba) {
    const Vec3 X_ab = random.nodes[b].X - random.nodes[a].X, S_ab = (C_ab - C_ba) / 2;
    const Mat3 difference = random.nodes[a].P - random.nodes[b].P;
    const Vec3& x = side == scheme::Side::rates ? X_ab : S_ab;
    const Vec3& y = side == scheme::Side::rates ? S_ab : X_ab;
    corrected[a] += kappa_f / random.graph.Omega[a] * (difference * x) * y.transpose();
  });
  for (std::int64_t b = 0; b < random.body.n_blocks; ++b) {
    Lanes Q[9];
    scheme::corrected_block<isa, side>(random.body.graph, tensors, kappa_f, b, Q);
    for (std::int64_t a = b * 8; a < std::min<std::int64_t>(random.graph.n_nodes(), b * 8 + 8);
         ++a) {
      for (int k = 0; k < 9; ++k)
        ASSERT_NEAR(Q[k][a % 8], corrected[static_cast<size_t>(a)](k / 3, k % 3), 1e-5);
    }
  }
}

TEST_P(Arrangements, FaceCorrectionsAreSumsOverPairs) {
  for (const Precision precision : {Precision::full, Precision::single}) {
    compare_correction<scheme::Side::rates>(GetParam(), precision);
    compare_correction<scheme::Side::stress>(GetParam(), precision);
  }
}

}  // namespace
}  // namespace diptych
