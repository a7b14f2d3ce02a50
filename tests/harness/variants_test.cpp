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

TEST(Variants, OfNothingAreTheCaseItself) {
  const auto variants = variants_of({});
  ASSERT_EQ(variants.size(), 1u);
  EXPECT_TRUE(variants[0].overrides.empty());
}

TEST(Variants, OfMalformedTextAreRefused) {
  for (const char* text : {"kappa", "=1", "sph.kappa=", "sph.kappa=1,", "sph.kappa=1,,2"})
    EXPECT_THROW(variants_of({text}), base::InputError) << text;
}

}  // namespace
}  // namespace diptych::harness
