#include "common/scheme/graph/pair_graph.hpp"

#include "common/base/error.hpp"
#include "fvm/fvm_graph.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <gmock/gmock.h>
#include <limits>

namespace diptych::graphs {
namespace {

scheme::PairGraph sound_graph() {
  return fvm::build_graph(test_box(CellType::tetrahedron, 2, 0.1), {"integral"});
}

TEST(ValidatePairGraph, RefusesEachKindOfDamage) {
  using Graph = scheme::PairGraph;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(Graph&)>>> damages = {
      {"instead of", [](Graph& g) { g.Omega.pop_back(); }},
      {"instead of", [](Graph& g) { g.row.back() -= 1; }},
      {"volume -1", [](Graph& g) { g.Omega[5] = -1; }},
      {"no finite position", [&](Graph& g) { g.X[3][1] = nan; }},
      {"no finite C_ab", [&](Graph& g) { g.C.each()[7][2] = nan; }},
      {"boundary area", [&](Graph& g) { g.boundary_area[4][0] = nan; }},
      {"ascending",
       [](Graph& g) {
         std::swap(g.neighbour[0], g.neighbour[1]);
         std::swap(g.reverse_place[0], g.reverse_place[1]);
       }},
      {"not a pair both ways", [](Graph& g) { ++g.reverse_place[0]; }},
      {"neighbour 99", [](Graph& g) { g.neighbour[0] = 99; }},
      {"dimension", [](Graph& g) { g.dimension = 4; }},
      {"patch 'x_min'", [](Graph& g) { g.patches[0].nodes[0] = g.patches[0].nodes[1]; }},
      {"patch 'x_max'", [](Graph& g) { g.patches[1].area.pop_back(); }}};
  EXPECT_NO_THROW(scheme::validate(sound_graph()));
  for (const auto& [what, damage] : damages) {
    Graph graph = sound_graph();
    damage(graph);
    try {
      scheme::validate(graph);
      ADD_FAILURE() << "went through: " << what;
    } catch (const base::InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(what));
    }
  }
}

TEST(LinkReversePairs, RefusesAOneWayPair) {
  scheme::PairGraph graph = sound_graph();
  for (std::int64_t p = 0; p < graph.n_pairs(); ++p) {
    EXPECT_EQ(graph.reverse(graph.reverse(p)), p);
  }
  graph.neighbour.erase(graph.neighbour.begin());
  for (size_t a = 1; a < graph.row.size(); ++a)
    --graph.row[a];
  EXPECT_THROW(scheme::link_reverse_pairs(graph), base::InputError);
}

TEST(Quality, SeesASingleChangedCoefficient) {
  scheme::PairGraph graph = sound_graph();
  const scheme::GraphQuality sound = scheme::quality(graph);
  EXPECT_LT(sound.linear_exactness, 1e-13);
  EXPECT_LT(sound.closure, 1e-13);
  graph.C.each()[11][0] += 1e-3;
  EXPECT_GT(scheme::quality(graph).linear_exactness, 1e-5);
  EXPECT_GT(scheme::quality(graph).closure, 1e-3);
  graph.C.each()[11][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(scheme::quality(graph).closure));
}

}  // namespace
}  // namespace diptych::graphs
