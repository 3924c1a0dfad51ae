#include "nav/planning/canal.h"

#include <gtest/gtest.h>

#include "base/angle.h"
#include "engine/phantom/phantom.h"
#include "tests/support/mesh_builder.h"

namespace orthonav::nav::canal_test {
namespace {

/// Grid step of the search over tilts.
constexpr double kGrid_deg = 7.5;

const TriangleMesh& phantom_l3() {
  static const TriangleMesh mesh = engine::phantom({"L3"}).levels.front().mesh;
  return mesh;
}

TEST(Canal, LiesBehindTheBodyAndIsFree) {
  const SurfaceIndex bone(phantom_l3());
  const auto canal = find_canal(phantom_l3(), bone);
  ASSERT_TRUE(canal);
  EXPECT_FALSE(bone.contains(canal->centre_m));
  // The origin is the body's centroid: the back of the body lies some 16 mm behind it.
  EXPECT_GT(canal->centre_m.y, 0.016);
  EXPECT_NEAR(canal->centre_m.x, 0.0, 0.003);
  EXPECT_TRUE(bone.contains(canal->centre_m - (canal->to_body_m + 0.002) * canal->behind));
  EXPECT_LE(angle_between_rad(canal->up, {0, 0, 1}) * kDegreesPerRadian, kGrid_deg);
  EXPECT_NEAR(canal->left.cross(canal->behind).dot(canal->up), 1.0, 1e-12) << "right-handed";
}

TEST(Canal, FollowsAVertebraThatIsTiltedInItsScan) {
  for (const double tilt_deg : {-30.0, 25.0}) {
    const Mat3 tilt = rotation_from_vector(tilt_deg * kRadiansPerDegree * Vec3{1, 0, 0});
    const TriangleMesh mesh = test::rotated(phantom_l3(), tilt);
    const auto canal = find_canal(mesh, SurfaceIndex(mesh));
    ASSERT_TRUE(canal) << tilt_deg;
    const Vec3 up = tilt * Vec3{0, 0, 1};
    EXPECT_LE(angle_between_rad(canal->up, up) * kDegreesPerRadian, 1.5 * kGrid_deg) << tilt_deg;
  }
}

TEST(Canal, IsNoneWhereThereIsNoRingOfBone) {
  const TriangleMesh ball = test::sphere({}, 0.03, 20);
  EXPECT_FALSE(find_canal(ball, SurfaceIndex(ball)));
  const TriangleMesh box = test::box({-0.03, -0.03, -0.02}, {0.03, 0.03, 0.02});
  EXPECT_FALSE(find_canal(box, SurfaceIndex(box)));
}

TEST(Canal, IsNoneInAVertebraThatFacesBackward) {
  const TriangleMesh mesh =
      test::rotated(phantom_l3(), rotation_from_vector(180.0 * kRadiansPerDegree * Vec3{0, 0, 1}));
  EXPECT_FALSE(find_canal(mesh, SurfaceIndex(mesh))) << "RAS taken for LPS";
}

}  // namespace
}  // namespace orthonav::nav::canal_test
