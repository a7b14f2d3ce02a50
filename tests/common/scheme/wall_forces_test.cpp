/// What walls answer the forces at their nodes with, beside what holds these nodes.

#include "common/scheme/boundary/rigid_wall.hpp"
#include "tests/common/scheme/random_body.hpp"

#include <gtest/gtest.h>

namespace diptych::tests {
namespace {

using algebra::Mat3;

/// Support and wall at an angle: together they leave what is along the wall of the free directions.
TEST(WallForces, TakeFromWhatIsFreeWhatIsAgainstTheWall) {
  RandomBody body("fvm", {});
  body.evaluate();
  const std::int32_t node = 3;
  const Vec3 T = body.vector(body.state.T, node), normal(0.6, 0.8, 0);
  const double mass = body.state.options.rho_R * body.graph().Omega[node];
  for (const Vec3& held : {Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, 0, 0)}) {
    const Mat3 keep = Mat3::Identity() - held * held.transpose();
    scheme::WallContacts walls;
    const scheme::BoundaryPatch patch;
    walls.add({Vec3::Zero(), normal},
              {node, body.graph().Omega[node], body.graph().X[node], Vec3::Zero(), keep, &patch});
    walls.list_chunks();
    EXPECT_EQ(walls.squared_forces(body.state), 0) << "open";
    walls.restore({1});
    // of a node that stays in the plane of the wall and in the free directions
    const Vec3 along_free = (keep * normal).normalized();
    const Vec3 free = keep * T, left = free - free.dot(along_free) * along_free;
    EXPECT_NEAR(left.dot(normal), 0, 1e-12 * T.norm());
    EXPECT_NEAR(walls.squared_forces(body.state), (free.squaredNorm() - left.squaredNorm()) / mass,
                1e-12 * T.squaredNorm() / mass);
  }
}

}  // namespace
}  // namespace diptych::tests
