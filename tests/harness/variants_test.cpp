#include "benchmarks/study/variants.hpp"

#include "common/base/error.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::ElementsAre;

TEST(Variants, AreAllCombinationsTheLastFastest) {
  const auto variants = variants_of({"time.cfl=1.0,1.2", "scheme.face_correction=0,1/6"});
  ASSERT_EQ(variants.size(), 4u);
  EXPECT_EQ(variants[0].label, "cfl=1.0 face_correction=0");
  EXPECT_THAT(variants[1].overrides, ElementsAre("time.cfl=1.0", "scheme.face_correction=1/6"));
  EXPECT_EQ(variants[2].label, "cfl=1.2 face_correction=0");
  EXPECT_EQ(variants[3].method, "") << "of both";
}

TEST(Variants, OfAKeyOfOneMethodLeaveTheOtherAsItIs) {
  const auto variants = variants_of({"sph.kappa=1.0,1.2", "time.cfl=0.5,1"});
  ASSERT_EQ(variants.size(), 6u);
  EXPECT_EQ(variants[1].label, "kappa=1.0 cfl=1");
  EXPECT_EQ(variants[3].method, "sph");
  EXPECT_EQ(variants[4].method, "fvm");
  EXPECT_THAT(variants[4].overrides, ElementsAre("time.cfl=0.5"));
  EXPECT_EQ(variants[5].label, "cfl=1");
  EXPECT_EQ(variants_of({"sph.kappa=1.0,1.2"}).back().label, "") << "finite volumes once";
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
