/// Probes of a state that is known: an affine displacement, whose fields are constants.

#include "common/run/probes.hpp"

#include "common/base/error.hpp"
#include "meshes/cell_at.hpp"
#include "meshes/incidence.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych {
namespace {

using algebra::Vec3;
using testing::HasSubstr;
using tests::Scene;
using tests::scene_of;

const char* const stretched = R"([parameters]
k = 0.1
[mesh]
element = "hexahedron"
upper = [2, 1, 1]
cells = [4, 2, 2]
[material]
model = "mooney-rivlin"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
zeta_ratio = 0.5
[initial]
displacement = ["k*x", 0, 0]
velocity = [0, "3*x", 0]
[time]
end = 1
integrator = "ssp-rk3"
)";

std::string probe(const std::string& lines) {
  return "[[probe]]\nname = \"q\"\nunit = \"-\"\n" + lines + "\n";
}

run::Probes probes_of(const Scene& s) {
  const meshes::NodalGraph graph = meshes::nodal_graph(s.mesh.mesh);
  return {s.setup.probes,
          s.graph,
          {[&](std::int32_t a, std::vector<std::int32_t>& nodes) {
             const auto around = graph.around(a);
             nodes.insert(nodes.end(), around.begin(), around.end());
           },
           [&](const Vec3& place) { return meshes::nodes_of_cells_at(s.mesh.mesh, place); }}};
}

double value(const std::string& lines, const std::string& more = "") {
  Scene s = scene_of("fvm", stretched + more + probe(lines));
  return probes_of(s).values(*s.solver).at(0);
}

TEST(Probes, ReadEachKindFromKnownFields) {
  EXPECT_DOUBLE_EQ(value("at = [2, 1, 1]\nquantity = \"ux\""), 0.2);
  EXPECT_NEAR(value("at = [1.1, 0.4, 0.6]\nquantity = \"x + ux\""), 1.21, 1e-13);  // between nodes
  EXPECT_NEAR(value("at = [0.25, 0.25, 0.75]\nquantity = \"x + ux\""), 0.275, 1e-13);
  EXPECT_NEAR(value("kind = \"mean\"\nquantity = \"vy\""), 3, 1e-14);
  EXPECT_NEAR(value("kind = \"integral\"\nquantity = \"J\""), 2.2, 1e-14);
  EXPECT_NEAR(value("kind = \"mean\"\ngroup = \"y_max\"\nquantity = \"ux\""), 0.1, 1e-14);
  EXPECT_NEAR(value("kind = \"integral\"\ngroup = [\"x_max\", \"x_min\"]\nquantity = \"Fxx\""), 2.2,
              1e-14);
  EXPECT_DOUBLE_EQ(value("kind = \"least\"\nquantity = \"vy - 1\""), -1);
  EXPECT_DOUBLE_EQ(value("kind = \"greatest\"\ngroup = \"x_max\"\nquantity = \"k*vy\""), 0.6);
  EXPECT_NEAR(value("kind = \"mean\"\nregion = \"x >= 1 + k/2\"\nquantity = \"x\""),
              value("kind = \"integral\"\nquantity = \"x > 1 ? x : 0\"") /
                  value("kind = \"integral\"\nquantity = \"x > 1 ? 1 : 0\""),
              1e-14);
  EXPECT_DOUBLE_EQ(
      value("kind = \"least\"\ngroup = \"y_max\"\nregion = \"x > 1\"\nquantity = \"x\""), 1.5);
  // a linear field leaves nothing, a uniform one has nothing
  EXPECT_NEAR(value("kind = \"checkerboard\"\nquantity = \"vy - z\""), 0, 1e-14);
  EXPECT_EQ(value("kind = \"checkerboard\"\nquantity = \"Fxx\""), 0);
}

TEST(Probes, StressesAreThoseOfTheState) {
  Scene s = scene_of("fvm", stretched);
  const auto now = s.solver->snapshot();
  const run::Mat3 sigma = now.P[0] * now.F[0].transpose() / now.J[0];
  EXPECT_GT(sigma(0, 0), 1e4) << "nothing to compare";
  const double pressure = -sigma.trace() / 3;
  EXPECT_DOUBLE_EQ(value("at = [0, 0, 0]\nquantity = \"sxx\""), sigma(0, 0));
  EXPECT_NEAR(value("at = [0, 0, 0]\nquantity = \"p\""), pressure, 1e-9);
  // uniaxial: sigma_yy = sigma_zz
  EXPECT_NEAR(value("at = [0, 0, 0]\nquantity = \"mises\""), sigma(0, 0) - sigma(1, 1), 1e-9);
}

TEST(Probes, ReactionHoldsTheBodyThatIsPulled) {
  // uniform stretch between a roller plane and a traction-free end: the roller bears P_xx A
  const std::string roller = "[[boundary]]\ngroup = \"x_min\"\ntype = \"symmetry\"\n";
  const double P = value("at = [0, 0, 0]\nquantity = \"Pxx\"", roller);
  for (const char* integrator : {"leapfrog", "ssp-rk3"}) {
    Scene s = scene_of(
        "fvm",
        stretched + roller +
            probe("kind = \"reaction\"\ngroup = \"x_min\"\ndirection = [-2, 0, 0]"),
        {std::string("time.integrator=\"") + integrator + "\"", "initial.velocity=[0, 0, 0]"});
    // pulled outwards, the force on the body points to -x
    EXPECT_NEAR(probes_of(s).values(*s.solver).at(0), P, 1e-9 * P) << integrator;
  }
}

TEST(Probes, OfEveryStepAreASubset) {
  Scene s = scene_of("fvm", stretched + probe("at = [2, 1, 1]\nquantity = \"ux\"") +
                                "[[probe]]\nname = \"w\"\nunit = \"m\"\nevery_step = true\n"
                                "kind = \"mean\"\nquantity = \"2*t + Fxx\"\n");
  const run::Probes probes = probes_of(s);
  ASSERT_TRUE(probes.has_stepped());
  ASSERT_EQ(probes.stepped_values(*s.solver).size(), 1u);
  EXPECT_DOUBLE_EQ(probes.stepped_values(*s.solver)[0], 1.1);
  EXPECT_TRUE(run::Probes({}, s.graph, {}).empty());
}

std::string refusal(const std::string& text) {
  try {
    Scene s = scene_of("fvm", stretched + text);
    probes_of(s);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Probes, BadOnesAreRefusedWithAPlaceAndAWayOut) {
  EXPECT_THAT(refusal(probe("at = [5, 0, 0]\nquantity = \"ux\"")), HasSubstr("away from"));
  EXPECT_THAT(refusal(probe("at = [2.2, 0.5, 0.5]\nquantity = \"ux\"")), HasSubstr("in no cell"));
  EXPECT_THAT(refusal(probe("quantity = \"ux\"")), HasSubstr("probe.0.at is missing"));
  EXPECT_THAT(refusal(probe("at = [0, 0, 0]\nquantity = \"uxx\"")), HasSubstr("'ux'"));
  EXPECT_THAT(refusal(probe("kind = \"mean\"\ngroup = \"x_mx\"\nquantity = \"ux\"")),
              HasSubstr("'x_max'"));
  EXPECT_THAT(refusal(probe("kind = \"least\"\nat = [0, 0, 0]\nquantity = \"ux\"")),
              HasSubstr("no effect on kind"));
  EXPECT_THAT(refusal(probe("kind = \"mean\"\nregion = \"x > 2\"\nquantity = \"ux\"")),
              HasSubstr("no node of probe 'q' is in its region"));
  EXPECT_THAT(refusal(probe("kind = \"mean\"\nregion = \"x > t\"\nquantity = \"ux\"")),
              HasSubstr("depends on the time"));
  EXPECT_THAT(refusal(probe("kind = \"mean\"\nregion = \"ux > 2\"\nquantity = \"ux\"")),
              HasSubstr("ux"));
  EXPECT_THAT(refusal(probe("at = [0, 0, 0]\nregion = \"x > 2\"\nquantity = \"ux\"")),
              HasSubstr("no effect on kind"));
  EXPECT_THAT(refusal(probe("kind = \"checkerboard\"\ngroup = \"x_max\"\nquantity = \"ux\"")),
              HasSubstr("no effect on kind"));
  EXPECT_THAT(refusal(probe("kind = \"reaction\"\ngroup = \"x_min\"\ndirection = [0, 0, 0]")),
              HasSubstr("no direction"));
  const std::string sound = probe("at = [0, 0, 0]\nquantity = \"ux\"");
  EXPECT_THAT(refusal(sound + sound), HasSubstr("already called 'q'"));
  EXPECT_THAT(refusal("[functions.J]\ntype = \"expression\"\nvalue = \"t\"\n" + sound),
              HasSubstr("rename the parameter or function 'J'"));
  EXPECT_EQ(refusal(sound), "accepted");
}

}  // namespace
}  // namespace diptych
