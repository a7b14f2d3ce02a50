/// Notices of fields that change between the nodes of a mesh.

#include "benchmarks/run/unseen_fields.hpp"

#include "common/cases/reader.hpp"
#include "meshes/generators.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

std::vector<std::string> notices_of(const std::string& fields) {
  const cases::Case setup = cases::case_from_text(
      "[mesh]\ncells = [10, 10, 10]\n[material]\nmodel = \"neo-hookean\"\ndensity = 1000\n"
      "youngs_modulus = 1e6\npoissons_ratio = 0.3\n[time]\nend = 1\n" +
          fields,
      "scene", {});
  std::vector<std::string> notices;
  note_unseen_fields(setup,
                     meshes::box(meshes::CellType::hexahedron, {0, 0, 0}, {1, 1, 1}, {10, 10, 10}),
                     notices);
  return notices;
}

TEST(UnseenFields, AreToldOfWhereNodesMissASpotOrAWave) {
  for (const char* field :
       {"[load]\nbody_force = [0, 0, \"abs(x - 0.45) < 0.02 && abs(y - 0.55) < 0.02 ? 1e6 : 0\"]\n",
        "[load]\nbody_force = [0, 0, \"t > 0.5 ? 1e6*sin(10*pi*x) : 0\"]\n",
        "[initial]\nvelocity = [\"(x - 0.45)^2 + (y - 0.55)^2 < 0.0016 ? 100 : 0\", 0, 0]\n",
        "[[boundary]]\ngroup = [\"x_min\"]\ntype = \"velocity\"\n"
        "value = [\"abs(y - 0.55) < 0.02 ? 1 : 0\", 0, 0]\n"}) {
    const auto notices = notices_of(field);
    ASSERT_EQ(notices.size(), 1U) << field;
    EXPECT_THAT(notices[0], testing::HasSubstr("between the nodes it differs by"));
  }
}

TEST(UnseenFields, AreNotToldOfWhatNodesSee) {
  EXPECT_TRUE(notices_of("[load]\nbody_force = [0, 0, \"x > 0.52 ? 1e6*t : 0\"]\n").empty());
  EXPECT_TRUE(notices_of("[load]\nbody_force = [\"1e3*x\", \"sin(6*y)\", 0]\n").empty());
  EXPECT_TRUE(notices_of("[initial]\nvelocity = [\"x < 0.25 ? 3 : 0\", 0, 0]\n").empty());
  EXPECT_TRUE(notices_of("[[boundary]]\ngroup = [\"x_min\"]\ntype = \"velocity\"\n"
                         "value = [\"y < 0.55 ? 1 : 0\", \"z*t\", 0]\n")
                  .empty());
}

}  // namespace
}  // namespace diptych::harness
