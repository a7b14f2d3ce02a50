#include "benchmarks/study/variants.hpp"

#include "common/base/error.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::ElementsAre;

TEST(Variants, AreAllCombinationsTheLastFastest) {
  const auto variants = variants_of({"sph.kappa=1.0,1.2", "scheme.face_correction=0,1/6"});
  ASSERT_EQ(variants.size(), 4u);
  EXPECT_EQ(variants[0].label, "kappa=1.0 face_correction=0");
  EXPECT_THAT(variants[1].overrides, ElementsAre("sph.kappa=1.0", "scheme.face_correction=1/6"));
  EXPECT_EQ(variants[2].label, "kappa=1.2 face_correction=0");
}

TEST(Variants, MayBeListsCallsAndTexts) {
  const auto overrides = [](const std::string& text) {
    std::vector<std::string> all;
    for (const Variant& variant : variants_of({text}))
      all.push_back(variant.overrides.front());
    return all;
  };
  EXPECT_THAT(overrides("mesh.cells=[4,4],[8,8]"),
              ElementsAre("mesh.cells=[4,4]", "mesh.cells=[8,8]"));
  EXPECT_THAT(overrides("initial.velocity.0=\"max(x,y)\",min(x,2)"),
              ElementsAre("initial.velocity.0=\"max(x,y)\"", "initial.velocity.0=min(x,2)"));
  EXPECT_EQ(variants_of({"initial.velocity.0=1,2"})[1].label, "velocity.0=2") << "not 0=2";
}

TEST(Variants, OfNothingAreTheCaseItself) {
  const auto variants = variants_of({});
  ASSERT_EQ(variants.size(), 1u);
  EXPECT_TRUE(variants[0].overrides.empty());
}

TEST(Variants, OfMalformedTextAreRefused) {
  for (const char* text : {"kappa", "=1", "sph.kappa=", "sph.kappa=1,", "sph.kappa=1,,2",
                           "mesh.cells=[4,4", "mesh.cells=4]", "time.end=\"1,2"})
    EXPECT_THROW(variants_of({text}), base::InputError) << text;
}

}  // namespace
}  // namespace diptych::harness
