#include "meshes/united_groups.hpp"

#include "common/base/error.hpp"

#include <gtest/gtest.h>

namespace diptych::meshes {
namespace {

TEST(UnitedGroups, HaveEachFaceOnceAndAreMadeWhereGroupsHaveFacesInCommon) {
  Mesh mesh;
  mesh.boundary_groups = {{"a", {0, 1, 2}}, {"b", {2, 3}}, {"c", {4}}};
  for (const std::vector<std::string>& apart :
       {std::vector<std::string>{"a", "c"}, {"b"}, {"b", "c", "unknown"}})
    unite_overlapping(apart, mesh);
  EXPECT_EQ(mesh.boundary_groups.size(), 3u);
  for (int time = 0; time < 2; ++time)
    unite_overlapping({"a", "b", "c"}, mesh);
  ASSERT_EQ(mesh.boundary_groups.size(), 4u);
  EXPECT_EQ(mesh.group(united_name({"a", "b", "c"})).faces,
            (std::vector<std::int32_t>{0, 1, 2, 3, 4}));
}

TEST(UnitedGroups, AreNotMistakenForAGroupThatIsCalledSo) {
  for (const char* other : {"b", "c"}) {  // with a face in common, and without
    Mesh mesh;
    mesh.boundary_groups = {{"a", {0, 1}}, {"b", {1, 2}}, {"c", {3}}};
    mesh.boundary_groups.push_back({united_name({"a", other}), {4, 5}});
    EXPECT_THROW(unite_overlapping({"a", other}, mesh), base::InputError) << other;
  }
}

}  // namespace
}  // namespace diptych::meshes
