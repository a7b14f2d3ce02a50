#include "common/algebra/shared_vectors.hpp"

#include <gtest/gtest.h>

namespace diptych {

using algebra::SharedVectors;
using algebra::Vec3;

namespace {

SharedVectors three_of_two() {
  return {{Vec3(1, 2, 3), Vec3(4, 5, 6)}, {1, 0, 1}};
}

}  // namespace

TEST(SharedVectors, StandOnceForSeveralPlaces) {
  const SharedVectors vectors = three_of_two();
  ASSERT_EQ(vectors.size(), 3U);
  EXPECT_EQ(vectors[0], Vec3(4, 5, 6));
  EXPECT_EQ(vectors[1], Vec3(1, 2, 3));
  EXPECT_EQ(vectors[2], Vec3(4, 5, 6));
  int n = 0;
  vectors.for_each_alike([&](const Vec3&) { ++n; });
  EXPECT_EQ(n, 2);
}

TEST(SharedVectors, ChangeAtOnePlaceAlone) {
  SharedVectors vectors = three_of_two(), same = vectors;
  same.each();
  EXPECT_FALSE(same.is_shared());
  EXPECT_EQ(vectors, same);
  same.each()[0] = Vec3::Zero();
  EXPECT_EQ(same[2], Vec3(4, 5, 6));
  EXPECT_FALSE(vectors == same);
}

TEST(SharedVectors, ArePutAsAnotherPlace) {
  for (const bool is_shared : {true, false}) {
    SharedVectors vectors = three_of_two();
    if (!is_shared) vectors.each();
    vectors.put_as(2, 1);
    vectors.change_alike([](Vec3& v) { v *= 2; });
    EXPECT_EQ(vectors, SharedVectors({Vec3(8, 10, 12), Vec3(2, 4, 6), Vec3(2, 4, 6)}));
  }
}

}  // namespace diptych
