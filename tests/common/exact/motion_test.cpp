/// Motions of case files and their rates; the derivatives of expressions are tested with programs.

#include "common/exact/manufactured/motion.hpp"

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gmock/gmock.h>

namespace diptych::exact {
namespace {

using testing::HasSubstr;

const functions::Vocabulary vocabulary{{{"a", 0.3}, {"w", 2.5}}, {}};

TEST(Motion, GivesVelocityAndAcceleration) {
  const Motion motion({{"a*t^3*x", {}}, {"sin(w*t)*y", {}}}, vocabulary);
  const Vec3 X(0.5, 2, 0);
  EXPECT_EQ(motion.dimension(), 2);
  EXPECT_NEAR((motion.displacement(X, 2) - Vec3(0.3 * 8 * 0.5, 2 * std::sin(5), 0)).norm(), 0,
              1e-15);
  EXPECT_NEAR((motion.velocity(X, 2) - Vec3(0.3 * 12 * 0.5, 5 * std::cos(5), 0)).norm(), 0, 2e-15);
  EXPECT_NEAR((motion.acceleration(X, 2) - Vec3(0.3 * 12 * 0.5, -12.5 * std::sin(5), 0)).norm(), 0,
              5e-15);
}

// ---- case files
const std::string head = R"(
[mesh]
element = "quadrilateral"
cells = [4, 4]
[material]
model = "neo-hookean"
density = 1
shear_modulus = 1
lame = 1
[time]
end = 1
)";
const std::string motion = "[manufactured]\ndisplacement = [\"0.1*t*x\", 0.5]\n";
const std::string edge = "[[boundary]]\ngroup = \"x_min\"\n";

std::string complaint(const std::string& tail) {
  try {
    cases::case_from_text(head + tail, "case.toml");
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ManufacturedCase, HasTheMotionAndItsInitialState) {
  const cases::Case c = cases::case_from_text(
      head + motion + edge + "type = \"traction\"\nvalue = \"manufactured\"\n", "case.toml");
  ASSERT_NE(c.motion, nullptr);
  EXPECT_EQ(c.initial.motion, c.motion);
  EXPECT_TRUE(c.boundaries[0].manufactured);
  EXPECT_EQ(c.motion->velocity(Vec3(2, 3, 0), 0.3), Vec3(0.2, 0, 0));
  EXPECT_EQ(c.motion->displacement(Vec3(2, 3, 0), 0.5), Vec3(0.1, 0.5, 0));
  EXPECT_EQ(cases::case_from_text(head, "case.toml").motion, nullptr);
}

TEST(ManufacturedCase, RefusesWhatTheMotionAlreadyGives) {
  EXPECT_THAT(complaint(motion + "[load]\nbody_force = [1, 0]\n"),
              HasSubstr("load.body_force is already given by the motion"));
  EXPECT_THAT(complaint(motion + "[initial]\nvelocity = [1, 0]\n"),
              HasSubstr("initial.velocity is already given"));
  EXPECT_THAT(complaint(motion + "[exact]\ndisplacement = [1, 0]\n"),
              HasSubstr("exact.displacement is already given"));
  EXPECT_THAT(complaint("[manufactured]\n"), HasSubstr("manufactured.displacement is missing"));
  EXPECT_THAT(complaint("[manufactured]\ndisplacement = [\"abs(x)\", 0]\n"),
              HasSubstr("case.toml:13:18: in the motion 'abs(x)': the function 'abs'"));
  EXPECT_THAT(complaint("[manufactured]\ndisplacement = [\"x +\", 0]\n"),
              HasSubstr("it ends too early"));
}

TEST(ManufacturedCase, BoundariesFollowOnlyAMotionThatIsThere) {
  EXPECT_THAT(complaint(edge + "type = \"velocity\"\nvalue = \"manufactured\"\n"),
              HasSubstr("needs a motion; give it in [manufactured]"));
  EXPECT_THAT(complaint(motion + edge + "type = \"pressure\"\nvalue = \"manufactured\"\n"),
              HasSubstr("unknown name 'manufactured'"));
}

}  // namespace
}  // namespace diptych::exact
