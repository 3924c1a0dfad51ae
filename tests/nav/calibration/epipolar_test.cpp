#include "nav/calibration/epipolar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/nav/calibration/board_cameras.h"

namespace orthonav::nav::stereo_board_test {
namespace {

// The interpolation error of the camera's table.
constexpr double kTablePx = 1e-4;

TEST(Epipolar, MeasuresInPixelsOfTheRightImage) {
  const Cameras cameras;
  const auto left = CameraModel::from_brown_conrady(cameras.left).value();
  const auto right = CameraModel::from_brown_conrady(cameras.right).value();
  Random random(8);
  for (int i = 0; i < 50; ++i) {
    const Point<LeftCamera> p{
        {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0.3, 0.6)}};
    const Vec2 in_left = seen(cameras.left, p.v);
    const Vec2 in_right = seen(cameras.right, (cameras.right_from_left * p).v);
    const auto off = [&](Vec2 moved) {
      return across_epipolar_px(left, right, cameras.right_from_left, in_left, in_right + moved)
          .value();
    };
    EXPECT_NEAR(off({}), 0.0, kTablePx);
    // The baseline runs down the images: only the part across it counts, with its whole length.
    EXPECT_NEAR(std::hypot(off({0.5, 0}), off({0, 0.5})), 0.5, 0.01);
  }
  EXPECT_FALSE(
      across_epipolar_px(left, right, cameras.right_from_left, {-50, 10}, {320, 240}).has_value());
}

}  // namespace
}  // namespace orthonav::nav::stereo_board_test
