/// A run against its exact solution, chunk by chunk: what all comes to, whoever has the chunks.

#include "common/run/exact_survey.hpp"

#include "common/scheme/body/node_chunks.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace diptych::run {
namespace {

/// A square of several chunks of nodes, with fields that it does not follow.
const std::string square = R"toml([mesh]
element = "quadrilateral"
upper = [1, 0.5]
cells = [40, 20]
[material]
model = "neo-hookean"
density = 3
youngs_modulus = 10
poissons_ratio = 0.3
[initial]
velocity = ["0.1*sin(x)", "0.2*y"]
[time]
end = 0.1
[exact]
displacement = ["0.1*t*sin(x) + 1e-2*t*y", "0.1*t*abs(y - 0.2)"]
velocity = ["0.1*sin(x)", "0.1*x*y"]
)toml";

struct Surveyed {
  explicit Surveyed(const std::string& method)
      : scene(tests::scene_of(method, square)), survey(scene.setup, *scene.solver, scene.graph) {
    tests::run_to(*scene.solver, 0.05);
  }
  tests::Scene scene;
  ExactSurvey survey;
};

class ExactSurveys : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Both, ExactSurveys, testing::Values("sph", "fvm"));

TEST_P(ExactSurveys, SumTheErrorsOfAllNodes) {
  Surveyed of(GetParam());
  const Solver& solver = *of.scene.solver;
  const ExactSums sums = sums_of({of.survey.answer(solver, {})});
  const scheme::PairGraph& graph = of.scene.graph;
  const Snapshot state = solver.snapshot();
  const Snapshot exact = ExactFields(of.scene.setup, graph.X, length_of(graph), [&](const Mat3& F) {
                           return solver.equilibrium_stress(F);
                         }).at(state.time);
  const auto errors = nodal_errors(of.scene.setup, state, exact);
  EXPECT_EQ(errors.size(), 6U);
  for (size_t k = 0; k < compared_fields().size(); ++k) {
    const auto found = errors.find(compared_fields()[k]);
    ASSERT_EQ(sums.has[k], found != errors.end());
    if (!sums.has[k]) continue;
    double l1 = 0, l2 = 0, linf = 0;
    for (size_t a = 0; a < graph.X.size(); ++a) {
      const double e = found->second[a];
      l1 += graph.Omega[a] * e;
      l2 += graph.Omega[a] * e * e;
      linf = std::max(linf, e);
    }
    const SizeSums& error = sums.fields[k].error;
    EXPECT_GT(l1, 0);
    EXPECT_NEAR(error.l1 / l1, 1, 1e-13) << found->first;
    EXPECT_NEAR(error.l2 / l2, 1, 1e-13) << found->first;
    EXPECT_EQ(error.linf, linf) << found->first;
  }
  double kinetic = 0;
  for (size_t a = 0; a < graph.X.size(); ++a)
    kinetic += 1.5 * graph.Omega[a] * exact.v[a].squaredNorm();
  EXPECT_NEAR(sums.kinetic / kinetic, 1, 1e-13);
  EXPECT_GT(sums.fields[0].exact.l2, 0);
}

TEST_P(ExactSurveys, DoNotHangOnWhoHasTheChunks) {
  Surveyed of(GetParam());
  const std::vector<double> whole = of.survey.answer(*of.scene.solver, {});
  const auto n_chunks =
      static_cast<size_t>(scheme::chunk_of_node(of.scene.graph.n_nodes() - 1) + 1);
  ASSERT_GE(n_chunks, 4U);
  ASSERT_EQ(whole.size() % n_chunks, 0U);
  const size_t each = whole.size() / n_chunks;
  Answers answers(2);
  for (size_t c = n_chunks; c-- > 0;) {  // one after the other, the last first
    const auto from = whole.begin() + static_cast<std::ptrdiff_t>(c * each);
    answers[c % 2].insert(answers[c % 2].end(), from, from + static_cast<std::ptrdiff_t>(each));
  }
  const ExactSums one = sums_of({whole}), two = sums_of(answers);
  for (size_t k = 0; k < one.fields.size(); ++k) {
    EXPECT_EQ(one.fields[k].error.l1, two.fields[k].error.l1);
    EXPECT_EQ(one.fields[k].error.l2, two.fields[k].error.l2);
    EXPECT_EQ(one.fields[k].exact.l2, two.fields[k].exact.l2);
  }
  EXPECT_EQ(one.kinetic, two.kinetic);
  EXPECT_EQ(one.momentum, two.momentum);
}

TEST_P(ExactSurveys, KnowTheFieldsOfAFewNodes) {
  Surveyed of(GetParam());
  const std::vector<std::int32_t> nodes{3, 400, 401};
  std::vector<Vec3> X;
  for (const std::int32_t a : nodes)
    X.push_back(of.scene.graph.X[static_cast<size_t>(a)]);
  of.survey.read_at(nodes, X);
  of.survey.answer(*of.scene.solver, {});
  const Snapshot& fields = of.survey.at_nodes();
  ASSERT_EQ(fields.v.size(), nodes.size());
  EXPECT_EQ(fields.time, of.scene.solver->time());
  for (size_t k = 0; k < nodes.size(); ++k) {
    EXPECT_NEAR(fields.v[k][0], 0.1 * std::sin(X[k][0]), 1e-15);
    EXPECT_NEAR(fields.u[k][1], 0.1 * fields.time * std::abs(X[k][1] - 0.2), 1e-15);
  }
}

/// F of a displacement without a derivative, of a body of a size.
std::vector<Mat3> gradients(const std::string& displacement,
                            const std::vector<Vec3>& X,
                            double size) {
  const cases::Case setup = cases::case_from_text(
      square.substr(0, square.find("[exact]")) + "[exact]\ndisplacement = " + displacement,
      "square", {});
  return ExactFields(setup, X, size, [](const Mat3& F) { return F; }).at(0).F;
}

TEST(ExactGradients, HaveDifferencesOfTheSizeOfTheBody) {
  for (const double size : {1e-3, 1.0, 1e3}) {
    const std::vector<Vec3> X{{0.3 * size, 0.2 * size, 0}, {0.9 * size, 0.5 * size, 0}};
    const auto F = gradients(
        fmt::format("[\"{0}*0.1*sin(2*x/{0})*abs(1)\", \"{0}*0.1*cos(3*y/{0})\"]", size), X, size);
    for (size_t a = 0; a < X.size(); ++a) {
      EXPECT_NEAR(F[a](0, 0), 1 + 0.2 * std::cos(2 * X[a][0] / size), 1e-11) << size;
      EXPECT_NEAR(F[a](1, 1), 1 - 0.3 * std::sin(3 * X[a][1] / size), 1e-11) << size;
    }
  }
}

TEST(ExactGradients, AreDifferencesWhereTheDerivativeIsNoNumber) {
  const auto F =
      gradients("[\"x*sqrt(x^2 + y^2)\", \"y*sqrt(x^2 + y^2)\"]", {{0, 0, 0}, {0.3, 0.4, 0}}, 1);
  EXPECT_NEAR((F[0] - Mat3::Identity()).norm(), 0, 0.01);
  EXPECT_NEAR(F[1](0, 0), 1 + 0.5 + 0.3 * 0.3 / 0.5, 1e-12);
  EXPECT_NEAR(F[1](0, 1), 0.3 * 0.4 / 0.5, 1e-12);
}

/// A stress or a gradient that is given alone is held against the run, too.
TEST(ExactFieldsOf, EachFieldThatIsGiven) {
  std::string text = square.substr(0, square.find("[exact]")) + "[exact]\n";
  const std::pair<std::string, std::vector<std::string>> given[] = {
      {"stress = [[1, 2, 0], [3, 4, 0], [0, 0, 5]]\n", {"stress"}},
      {"deformation_gradient = [[2, 0], [0, 1]]\n",
       {"cofactor", "deformation_gradient", "jacobian", "stress"}},
      {"velocity = [1, 0]\nstress = [[1, 2, 0], [3, 4, 0], [0, 0, 5]]\n", {"stress", "velocity"}}};
  for (const auto& [exact, fields] : given) {
    const tests::Scene scene = tests::scene_of("fvm", text + exact);
    EXPECT_TRUE(ExactSurvey::is_for(scene.setup)) << exact;
    ExactSurvey survey(scene.setup, *scene.solver, scene.graph);
    const ExactSums sums = sums_of({survey.answer(*scene.solver, {})});
    std::vector<std::string> found;
    for (size_t k = 0; k < compared_fields().size(); ++k)
      if (sums.has[k]) found.push_back(compared_fields()[k]);
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(fields)) << exact;
  }
}

}  // namespace
}  // namespace diptych::run
