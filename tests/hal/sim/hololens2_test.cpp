#include "hal/sim/cameras/hololens2.h"

#include <gtest/gtest.h>

namespace orthonav::sim {
namespace {

TEST(HoloLens2, CamerasLieInTheRangesOfRealDevices) {
  for (const BrownConrady& camera : {hololens2_left(), hololens2_right()}) {
    EXPECT_EQ(camera.width_px, 640);
    EXPECT_EQ(camera.height_px, 480);
    EXPECT_GT(camera.fx_px, 355.0);
    EXPECT_LT(camera.fx_px, 366.0);
    EXPECT_NEAR(camera.cx_px, 320.0, 20.0);
    EXPECT_NEAR(camera.cy_px, 240.0, 20.0);
    EXPECT_NEAR(camera.k1, -0.04, 0.005);
  }
  const double baseline = hololens2_calibration().right_from_left().translation().norm();
  EXPECT_GT(baseline, 0.0983);
  EXPECT_LT(baseline, 0.0997);
}

TEST(HoloLens2, RigIsRightUpBackward) {
  // A point ahead and to the upper right of the wearer: the left image lies so that its x is up.
  const Point<Rig> ahead{{0.05, 0.10, -0.5}};
  const Vec3 in_left = (hololens2_calibration().left_from_rig * ahead).v;
  EXPECT_GT(in_left.z, 0.4);
  EXPECT_NEAR(in_left.x, 0.10, 0.01);
  EXPECT_NEAR(in_left.y, 0.05, 0.01);
  const Vec3 in_right = (hololens2_calibration().right_from_rig * ahead).v;
  EXPECT_GT(in_right.z, 0.4);
  EXPECT_NEAR(in_right.x, -0.10, 0.02);
  // The right camera stands to the right.
  EXPECT_NEAR(hololens2_calibration().right_from_rig.inverse().translation().x, 0.099, 1e-9);
  EXPECT_NEAR(hololens2_calibration().right_from_rig.rotation().determinant(), 1.0, 1e-12);
}

}  // namespace
}  // namespace orthonav::sim
