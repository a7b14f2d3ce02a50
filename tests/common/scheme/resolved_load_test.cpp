/// Forces of loads that change within a face, on the nodes of both methods.

#include "common/scheme/boundary/resolved_load.hpp"

#include "common/base/error.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace diptych::scheme {
namespace {

using Load = std::function<double(const Vec3& X, double t)>;

const char* const block = R"([mesh]
element = "hexahedron"
upper = [1, 1, 0.4]
cells = [10, 10, 4]
[material]
model = "mooney-rivlin"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
zeta_ratio = 0.5
[time]
end = 1
)";

/// The side z_max of a block.
class Side {
 public:
  Side(const std::string& method,
       const std::vector<std::string>& overrides,
       const std::vector<std::string>& groups = {"z_max"})
      : scene_(tests::scene_of(method, block, overrides)) {
    std::map<std::int32_t, Vec3> area;
    for (const BoundaryPatch& patch : scene_.graph.patches) {
      if (std::find(groups.begin(), groups.end(), patch.name) == groups.end()) continue;
      for (size_t k = 0; k < patch.nodes.size(); ++k)
        area.try_emplace(patch.nodes[k], Vec3::Zero()).first->second += patch.area[k];
      patch_.faces.insert(patch_.faces.end(), patch.faces.begin(), patch.faces.end());
    }
    for (const auto& [node, share] : area) {
      patch_.nodes.push_back(node);
      patch_.area.push_back(share);
      X_.push_back(scene_.graph.X[node]);
    }
    area_ = areas_as_numbers(scene_.graph, patch_);
  }
  const std::vector<Vec3>& X() const { return X_; }
  const SeenLoad& seen() const { return seen_; }  ///< of the last force or values
  std::vector<double> values(const Load& load,
                             std::vector<double> instants,
                             double t,
                             bool travels = false) const {
    seen_ = {};
    const FieldFunction<double> function(
        load, [load](std::span<const Vec3> X) { return FieldFunction<double>(load).placed(X); },
        {std::move(instants), travels});
    return resolved_load(function, X_, area_, faces_of(patch_), seen_)->at(t);
  }
  double force(const Load& load,
               std::vector<double> instants,
               double t,
               bool travels = false) const {
    const std::vector<double> pressures = values(load, std::move(instants), t, travels);
    double sum = 0;
    for (size_t k = 0; k < area_.size(); ++k)
      sum += area_[k] * pressures[k];
    return sum;
  }

 private:
  tests::Scene scene_;
  BoundaryPatch patch_;
  std::vector<Vec3> X_;
  std::vector<double> area_;
  mutable SeenLoad seen_;
};

using Meshed = std::tuple<std::string, std::string>;
class ResolvedLoad : public testing::TestWithParam<Meshed> {
 protected:
  ResolvedLoad()
      : side_(std::get<0>(GetParam()),
              {"mesh.element=" + std::get<1>(GetParam()), "mesh.perturbation=0"}) {}
  Side side_;
};
INSTANTIATE_TEST_SUITE_P(Both,
                         ResolvedLoad,
                         testing::Combine(testing::Values("sph", "fvm"),
                                          testing::Values("hexahedron", "tetrahedron")));

TEST_P(ResolvedLoad, HasTheForceOfItsIntegral) {
  struct Given {
    const char* name;
    Load load;
    double force, most;  ///< and by what part of it nodes may miss it
  };
  const Given loads[] = {
      {"between nodes", [](const Vec3& X, double) { return std::abs(X[0] - 0.45) < 0.03; }, 0.06,
       0.02},
      {"on nodes", [](const Vec3& X, double) { return std::abs(X[0] - 0.5) < 0.11; }, 0.22, 0.01},
      {"along an edge", [](const Vec3& X, double) { return X[1] < 0.05; }, 0.05, 0.02},
      {"part of the side", [](const Vec3& X, double) { return X[0] < 0.37; }, 0.37, 5e-3},
      {"a disc", [](const Vec3& X, double) { return std::hypot(X[0] - 0.43, X[1] - 0.52) < 0.2; },
       std::numbers::pi * 0.04, 5e-3},
      {"a peak",
       [](const Vec3& X, double) {
         return std::exp(-2500 * (X - Vec3(0.45, 0.55, X[2])).squaredNorm());
       },
       std::numbers::pi / 2500, 5e-3}};
  for (const auto& [name, load, force, most] : loads)
    EXPECT_NEAR(side_.force(load, {0}, 0), force, most * force) << name;
}

TEST_P(ResolvedLoad, IsNoneWhereItActsOnNodesAlone) {
  const Load sliver = [](const Vec3& X, double) { return X[0] > 0.9999; };
  EXPECT_NEAR(side_.force(sliver, {0}, 0), 0, 1e-9);
  ASSERT_TRUE(side_.seen().on_nodes_alone);
  EXPECT_EQ(side_.seen().on_nodes_alone->x(), 1);
  EXPECT_FALSE(side_.seen().within_faces);
  // fronts and spots that begin at a node have no area then, but later
  const Load front = [](const Vec3& X, double t) { return X[0] <= t; };
  EXPECT_NEAR(side_.force(front, {0, 0.31, 0.73}, 0.45, true), 0.45, 5e-3);
  EXPECT_NEAR(side_.force(front, {0, 0.31, 0.73}, 0, true), 0, 1e-9);
  // the nodes of a curved side lie on it, its faces do not
  const Load curved = [](const Vec3& X, double) {
    return std::abs(std::remainder(X[0], 0.1)) + std::abs(std::remainder(X[1], 0.1)) < 1e-9 ? 1 : 0;
  };
  EXPECT_NEAR(side_.force(curved, {0}, 0), 1, 0.01);
}

TEST(NodesAlone, AreRefusedUnlessAnotherGroupOfTheConditionSeesTheLoad) {
  const auto scene_with = [](const std::string& groups, const std::string& factor = "1") {
    return tests::scene_of("fvm", std::string(block) + "[[boundary]]\ngroup = " + groups +
                                      "\ntype = \"pressure\"\nvalue = \"x > 0.9999 ? " + factor +
                                      " : 0\"\n");
  };
  EXPECT_THROW(scene_with("[\"z_max\"]"), base::InputError);
  EXPECT_THROW(scene_with("[\"z_max\"]", "sin(t)"), base::InputError);
  EXPECT_NO_THROW(scene_with("[\"z_max\", \"x_max\"]"));
}

TEST_P(ResolvedLoad, GoesWithALoadThatTravels) {
  const Load strip = [](const Vec3& X, double t) {
    return std::abs(X[0] - 0.2 - t) < 0.04 ? 1 : 0;
  };
  for (const double t : {0.01, 0.13, 0.29, 0.55})
    EXPECT_NEAR(side_.force(strip, {0, 0.31, 0.73}, t), 0.08, 2e-3) << t;
  // off the side whenever it is looked at
  for (const double t : {0.29, 0.55})
    EXPECT_NEAR(side_.force(strip, {2, 3, 4}, t, true), 0.08, 2e-3) << t;
}

TEST_P(ResolvedLoad, LeavesWavesThatTravelToNodesThatResolveThem) {
  const Load wave = [](const Vec3& X, double t) { return std::sin(4 * (X[0] - t)); };
  EXPECT_EQ(side_.values(wave, {0, 0.31, 0.73}, 0.2, true), side_.values(wave, {}, 0.2));
}

TEST_P(ResolvedLoad, KeepsItsForceToItsPlaceOnAGroupOfTwoSides) {
  // what nodes on the edge have of both sides is no excess over what shape functions give them
  const Side both(std::get<0>(GetParam()), {"mesh.element=" + std::get<1>(GetParam())},
                  {"z_max", "x_max"});
  const auto part = [](const Vec3& X, double) { return X[1] < 0.37 ? 1.0 : 0.0; };
  const auto seen = both.values(part, {}, 0), resolved = both.values(part, {0}, 0);
  for (size_t k = 0; k < seen.size(); ++k)
    EXPECT_NEAR(resolved[k], seen[k], std::abs(both.X()[k][1] - 0.35) < 0.06 ? 0.3 : 1e-12);
}

TEST_P(ResolvedLoad, LeavesToNodesWhatTheyResolve) {
  for (const Load& load :
       {Load([](const Vec3&X, double) { return 3 + X[0] - 2 * X[1]; }),
        Load([](const Vec3&X, double) { return std::sin(4 * X[0]) * X[1] * X[1]; })})
    EXPECT_EQ(side_.values(load, {0}, 0), side_.values(load, {}, 0)) << "without a look";
}

}  // namespace
}  // namespace diptych::scheme
