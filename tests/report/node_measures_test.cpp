/// Numbers of the final state, on three nodes of volumes 1, 2 and 1.

#include "benchmarks/run/node_measures.hpp"

#include "common/base/error.hpp"

#include <gtest/gtest.h>

namespace diptych::harness {
namespace {

class NodeMeasures : public testing::Test {
 protected:
  NodeMeasures() {
    for (int a = 0; a < 3; ++a) {
      graph.X.emplace_back(a, 0, 0);
      graph.Omega.push_back(a == 1 ? 2 : 1);
      state.u.emplace_back(10 * a, 0, 0);
      state.v.emplace_back(0, a, 0);
      state.F.push_back(run::Mat3::Identity());
      state.P.push_back(run::Mat3::Identity() * a);
      state.P.back()(0, 1) = -a;
      state.J.push_back(1);
    }
    state.time = 0.5;
  }
  double of(const std::string& reduce, const std::string& value, const std::string& where = "1") {
    const functions::Vocabulary names = node_vocabulary({{"two", 2}});
    const NodeMeasure measure{"m", reduce, functions::Expression(value, names, {}),
                              functions::Expression(where, names, {}), ""};
    return measured({measure}, {graph, state, errors}).at("m");
  }
  scheme::PairGraph graph;
  scheme::Snapshot state;
  std::map<std::string, std::vector<double>> errors{{"velocity", {1, 2, 3}}};
};

TEST_F(NodeMeasures, ReduceFieldsOverAPartOfTheBody) {
  EXPECT_DOUBLE_EQ(of("mean", "u1"), 10);
  EXPECT_DOUBLE_EQ(of("integral", "u1*two"), 80);
  EXPECT_DOUBLE_EQ(of("mean", "v2", "x > two*t - 0.5"), 4.0 / 3);
  EXPECT_DOUBLE_EQ(of("min", "P12 + P33/4"), -1.5);
  EXPECT_DOUBLE_EQ(of("max", "F11 + J"), 2);
  EXPECT_DOUBLE_EQ(of("integral", "error_velocity^2"), 1 + 2 * 4 + 9);
}

TEST_F(NodeMeasures, RefuseAnEmptyPartAndGiveNothingWithoutAState) {
  EXPECT_THROW(of("mean", "u1", "x > 9"), base::InputError);
  EXPECT_THROW(of("mean", "error_stress"), base::InputError) << "there is no such error";
  state = {};
  EXPECT_THROW(of("mean", "u1"), std::out_of_range) << "no value of that name";
}

}  // namespace
}  // namespace diptych::harness
