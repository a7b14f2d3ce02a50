/// A scene is what the keys of its case say: mesh of the level, graph of the method's options,
/// precision; its parts are told of in order.

#include "benchmarks/run/scene.hpp"

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::ElementsAre;

const char* const square = R"([mesh]
element = "quadrilateral"
upper = [1, 1]
cells = [8, 8]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[time]
end = 1
)";

CaseGraph graph_with(const std::string& method, const std::vector<std::string>& overrides) {
  return graph_of(cases::case_from_text(square, "scene", overrides), method, 0);
}

TEST(Scene, HasTheGraphThatTheKeysOfTheMethodAskFor) {
  const auto pairs = [](const char* method, const std::vector<std::string>& overrides) {
    return graph_with(method, overrides).graph.n_pairs();
  };
  EXPECT_LT(pairs("sph", {"sph.kappa=0.75"}), pairs("sph", {}));
  EXPECT_LT(pairs("sph", {}), pairs("sph", {"sph.kernel=\"quintic-spline\""}));
  EXPECT_EQ(pairs("fvm", {"sph.kappa=0.75"}), pairs("fvm", {}));
  EXPECT_LT(pairs("fvm", {}), pairs("fvm", {"fvm.stencil=\"integral\""}));
  EXPECT_LT(pairs("fvm", {"fvm.stencil=\"edge\""}), pairs("fvm", {"fvm.stencil=\"sbp\""}));
  const auto Omega = graph_with("sph", {"sph.gradient=\"sbp\""}).graph.Omega;
  EXPECT_LT(
      Omega[0],
      graph_with("sph", {"sph.gradient=\"corrected\""}).graph.Omega[0]);  // (3/8)^2 beside (1/2)^2
}

// Their linear reconstructions gave energy on long cells and coarse tetrahedra, and braked what
// bends.
TEST(Scene, HasSymmetricReconstructionsWhereOperatorsSumByPartsOffBoxes) {
  const auto reconstruction = [](const char* upper, const char* moved,
                                 std::vector<std::string> overrides = {}) {
    overrides.push_back(std::string("mesh.upper=") + upper);
    overrides.push_back(std::string("mesh.perturbation=") + moved);
    const std::string of_sph = graph_with("sph", overrides).reconstruction;
    EXPECT_EQ(graph_with("fvm", overrides).reconstruction, of_sph);
    return of_sph;
  };
  EXPECT_EQ(reconstruction("[4, 1]", "0.2"), "symmetric");
  EXPECT_EQ(reconstruction("[1, 2]", "0.2", {"fvm.stencil=sbp", "sph.gradient=sbp"}), "symmetric");
  EXPECT_EQ(reconstruction("[1, 2]", "0.2", {"fvm.stencil=edge", "sph.gradient=corrected"}), "");
  EXPECT_EQ(reconstruction("[4, 1]", "0"), "");
  EXPECT_EQ(reconstruction("[1, 1]", "0.2"), "symmetric");
  EXPECT_EQ(reconstruction("[1, 1]", "0", {"mesh.element=triangle"}), "symmetric");
  EXPECT_EQ(reconstruction("[1, 1]", "0"), "");
  EXPECT_EQ(reconstruction("[4, 1]", "0.2", {"scheme.reconstruction=linear"}), "");
  EXPECT_EQ(reconstruction("[4, 1]", "0.2", {"scheme.limiter=sign-preserving"}), "");
  EXPECT_EQ(reconstruction("[4, 1]", "0.2", {"scheme.face_correction=0.125"}), "");
}

TEST(Scene, RefusesTheFaceCorrectionWithOperatorsThatSumByParts) {
  for (const char* method : {"sph", "fvm"}) {
    EXPECT_THROW(graph_with(method, {"sph.gradient=\"sbp\"", "fvm.stencil=\"sbp\"",
                                     "scheme.face_correction=\"1/6\""}),
                 base::InputError)
        << method;
  }
}

TEST(Scene, TakesOperatorsThatSumByPartsByDefaultWhereTheyAreSure) {
  const auto operators = [](const char* method, const std::vector<std::string>& overrides) {
    return graph_with(method, overrides).operators;
  };
  EXPECT_THAT(operators("sph", {}), testing::StartsWith("sbp"));
  EXPECT_THAT(operators("fvm", {}), testing::StartsWith("sbp"));
  EXPECT_THAT(operators("sph", {"mesh.cells=[2, 9]"}), testing::StartsWith("sbp"));
  EXPECT_THAT(operators("sph", {"mesh.cells=[1, 1]"}), testing::HasSubstr("lines of 2 nodes"));
  EXPECT_THAT(operators("fvm", {"mesh.cells=[3, 6]"}),
              testing::HasSubstr("sbp: order 2 on 4 nodes along (1, 0, 0), order 2 on 7 nodes"));
  EXPECT_THAT(operators("fvm", {"mesh.cells=[1, 1]"}), testing::HasSubstr("lines of 2 nodes"));
  EXPECT_THAT(operators("sph", {"sph.kappa=0.75"}), testing::HasSubstr("two spacings"));
  EXPECT_THAT(operators("sph", {"sph.kappa=2"}), testing::StartsWith("sbp"));
  EXPECT_THAT(operators("sph", {"sph.kappa=2.1"}), testing::HasSubstr("four spacings"));
  EXPECT_THAT(operators("sph", {"sph.closure=false"}), testing::HasSubstr("closure"));
  for (const char* method : {"sph", "fvm"}) {
    SCOPED_TRACE(method);
    EXPECT_THAT(operators(method, {"mesh.perturbation=0.1"}), testing::StartsWith("sbp"));
    EXPECT_THAT(operators(method, {"mesh.perturbation=0.1", "material.poissons_ratio=0.45"}),
                testing::StartsWith("sbp"));
    EXPECT_THAT(operators(method, {"scheme.face_correction=\"1/6\""}),
                testing::HasSubstr("face correction"));
    EXPECT_THAT(operators(method, {"scheme.volumes=cells"}),
                testing::HasSubstr("volumes of cells"));
  }
  for (const char* method : {"sph", "fvm"})
    EXPECT_THAT(operators(method, {"material.poissons_ratio=0.45"}), testing::StartsWith("sbp"));
  EXPECT_THAT(operators("sph", {"material.poissons_ratio=0.45", "scheme.volumes=nodes"}),
              testing::StartsWith("sbp"));
}

// On whose lines D_ab of linear jumps breaks bodies, and symmetric ones leave waves that SSP-RK2
// feeds: they sum by parts as any nodes do.
TEST(Scene, TakesCellsOnMovedBlocksOfThreeNodesAlongSeveralDirections) {
  const auto operators = [](const std::vector<std::string>& overrides) {
    return graph_with("fvm", overrides).operators;
  };
  const std::string moved = "mesh.perturbation=0.2";
  EXPECT_THAT(operators({"mesh.cells=[4, 2]", moved}), testing::StartsWith("sbp"));
  EXPECT_THAT(operators({"mesh.cells=[2, 2]", moved}),
              testing::StartsWith("sbp: order 2 on the cells"));
  EXPECT_THAT(operators({"mesh.cells=[3, 3]", moved}), testing::StartsWith("sbp"));
  EXPECT_THAT(operators({"mesh.cells=[2, 2]"}), testing::StartsWith("sbp"));
  EXPECT_THAT(operators({"mesh.cells=[2, 2]", moved, "fvm.stencil=sbp"}),
              testing::StartsWith("sbp"));
}

TEST(Scene, TellsOfReactionsThatNothingExerts) {
  const auto notices = [](const std::string& of_group) {
    const std::string held = R"([[boundary]]
group = "x_min"
type = "fixed"
[[boundary]]
group = "x_max"
type = "traction"
value = [1, 0]
[[probe]]
name = "hold"
unit = "N/m"
kind = "reaction"
direction = [1, 0]
group = ")" + of_group + "\"\n";
    return graph_of(cases::case_from_text(square + held, "scene", {}), "fvm", 0).notices;
  };
  EXPECT_TRUE(notices("x_min").empty());
  EXPECT_TRUE(notices("y_min").empty()) << "which is held at its end";
  EXPECT_THAT(notices("x_max"),
              ElementsAre(testing::HasSubstr("probe 'hold': no support or wall")));
}

TEST(Scene, SaysThatNodesCarryThePressureOfOperatorsThatSumByParts) {
  std::vector<std::string> asked{"sph.gradient=\"sbp\"", "fvm.stencil=\"sbp\"",
                                 "material.poissons_ratio=0.45",
                                 "initial.displacement=[\"0.1*x\", 0]"};
  EXPECT_THAT(graph_with("sph", asked).notices,
              testing::Contains(testing::HasSubstr("nodes carry the bulk pressure")));
  EXPECT_TRUE(graph_with("sph", asked).graph.lines.empty());
  asked.emplace_back("mesh.perturbation=0.1");
  EXPECT_THAT(graph_with("sph", asked).notices,
              testing::Contains(testing::HasSubstr("nodes carry the bulk pressure")));
  EXPECT_TRUE(graph_with("sph", asked).graph.cells.empty());
  asked.pop_back();
  EXPECT_TRUE(graph_with("fvm", asked).notices.empty());
}

TEST(Scene, DescribesOperatorsThatDependOnTheMesh) {
  EXPECT_EQ(graph_with("fvm", {"fvm.stencil=\"edge\""}).operators, "");
  EXPECT_NE(graph_with("fvm", {"fvm.stencil=\"sbp\""}).operators, "");
  EXPECT_EQ(graph_with("sph", {"sph.gradient=\"corrected\""}).operators, "");
  const CaseGraph fine = graph_with("sph", {"sph.gradient=\"sbp\""});
  EXPECT_THAT(fine.operators, testing::HasSubstr("kappa 1.2"));
  EXPECT_TRUE(fine.notices.empty());
  const CaseGraph coarse = graph_with(
      "sph", {"sph.gradient=\"sbp\"", "mesh.cells=[4, 9]", "scheme.reconstruction=\"linear\""});
  ASSERT_EQ(coarse.notices.size(), 1U);
  EXPECT_THAT(coarse.notices[0], testing::HasSubstr("5 nodes along (1, 0, 0)"));
}

TEST(Scene, TellsOfItsPartsInOrderAndIsOfItsLevel) {
  std::vector<ScenePart> parts;
  std::vector<std::int64_t> pairs;
  Scene scene(cases::case_from_text(square, "scene", {}), "fvm", 1, GraphPairs::released,
              [&](ScenePart part, const CaseGraph& made) {
                parts.push_back(part);
                pairs.push_back(made.graph.n_pairs());
              });
  EXPECT_THAT(parts, ElementsAre(ScenePart::mesh, ScenePart::graph, ScenePart::solver));
  EXPECT_THAT(pairs, ElementsAre(0, testing::Gt(4 * 17 * 15), 0));  // gone once the solver stands
  EXPECT_EQ(scene.graph.n_nodes(), 17 * 17);
  EXPECT_EQ(scene.solver->step(1).step, 1);
}

TEST(Scene, IsRefusedWhereNoMachineHasTheMemory) {
  EXPECT_THROW(graph_with("sph", {"mesh.cells=[40000, 40000]"}), base::EnvironmentError);
}

}  // namespace
}  // namespace diptych::harness
