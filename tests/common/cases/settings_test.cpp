/// Which settings of a case must stay where a run goes on, and how a change of one is told.

#include "common/cases/settings.hpp"

#include "common/cases/reader.hpp"

#include <gmock/gmock.h>

namespace diptych::cases {
namespace {

using testing::Contains;
using testing::Pair;

const char* const text = R"(title = "a \"block\""
[mesh]
element = "quadrilateral"
upper = [1, 2.5]
cells = [2, 3]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = "1e3*1e3"
poissons_ratio = 0.3
[[material.branch]]
beta_C = 0.5
tau_C = 1e-3
[time]
end = 0.03
[output]
frames = 2
)";

std::string settings_with(const std::vector<std::string>& overrides) {
  return settings_text(lasting_settings(case_from_text(text, "scene", overrides)));
}
std::string change_by(const std::vector<std::string>& overrides) {
  return changed_setting(settings_with({}), settings_with(overrides));
}

TEST(LastingSettings, AreTheKeysWithTheirPaths) {
  const auto settings = lasting_settings(case_from_text(text, "scene"));
  EXPECT_THAT(settings, Contains(Pair("mesh.element", "\"quadrilateral\"")));
  EXPECT_THAT(settings, Contains(Pair("mesh.upper.1", "2.5")));
  EXPECT_THAT(settings, Contains(Pair("mesh.cells.0", "2")));
  EXPECT_THAT(settings, Contains(Pair("material.youngs_modulus", "\"1e3*1e3\"")));
  EXPECT_THAT(settings, Contains(Pair("material.branch.0.tau_C", "0.001")));
  EXPECT_EQ(settings.count("time.end") + settings.count("output.frames"), 0u);
}

TEST(ChangedSetting, IsNoneOfThoseThatMayChange) {
  EXPECT_EQ(change_by({"time.end=0.1", "time.max_steps=7", "time.checkpoint_every=3",
                       "time.checkpoint_seconds=60", "output.frames=9", "output.fields=false"}),
            "");
  EXPECT_EQ(change_by({"material.density=1000"}), "") << "the same value";
}

TEST(ChangedSetting, IsToldWithBothValues) {
  EXPECT_EQ(change_by({"material.branch.0.tau_C=2e-3"}),
            "material.branch.0.tau_C was 0.001, is 0.002");
  EXPECT_EQ(change_by({"time.cfl=0.5"}), "time.cfl was not given, is 0.5");
  EXPECT_EQ(changed_setting(settings_with({"time.cfl=0.5"}), settings_with({})),
            "time.cfl was 0.5, is not given now");
  EXPECT_EQ(change_by({"mesh.cells=[2, 4]"}), "mesh.cells.1 was 3, is 4");
}

TEST(ChangedSetting, SeesFlags) {
  EXPECT_EQ(change_by({"scheme.angular_momentum_projection=false"}),
            "scheme.angular_momentum_projection was not given, is false");
  EXPECT_EQ(changed_setting(settings_with({"scheme.angular_momentum_projection=false"}),
                            settings_with({"scheme.angular_momentum_projection=true"})),
            "scheme.angular_momentum_projection was false, is true");
  EXPECT_EQ(change_by({"output.fields=false"}), "");
  EXPECT_EQ(changed_setting("a = 1\nno setting\n", "a = 1\n"), "");
}

TEST(ChangedSetting, SeesChangesOfTextsOfManyLines) {
  const auto with = [](const std::string& modulus) {
    std::string changed = text;
    changed.replace(changed.find("\"1e3*1e3\""), 9, "\"\"\"" + modulus + "\"\"\"");
    return settings_text(lasting_settings(case_from_text(changed, "scene")));
  };
  EXPECT_EQ(changed_setting(with("1e3*\n1e3"), with("1e3*\n1e3")), "");
  EXPECT_EQ(changed_setting(with("1e3*\n1e3"), with("1e3*\n2e3")),
            "material.youngs_modulus was \"1e3*\\n1e3\", is \"1e3*\\n2e3\"");
}

}  // namespace
}  // namespace diptych::cases
