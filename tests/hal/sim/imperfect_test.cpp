#include "hal/sim/cameras/imperfect.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/sim/cameras/hololens2.h"
#include "tests/hal/sim/test_rooms.h"

namespace orthonav::sim {
namespace {

TEST(PerturbedCalibration, IsTheReportedOneInAPerfectWorld) {
  const StereoCalibration reported = hololens2_calibration();
  const auto actual = perturbed(reported, ErrorModel::perfect(), Random(1));
  ASSERT_TRUE(actual.ok());
  EXPECT_EQ(actual->right_from_rig, reported.right_from_rig);
  EXPECT_EQ(actual->left.lookup()[1234], reported.left.lookup()[1234]);
}

TEST(PerturbedCalibration, IsOffByItsMagnitudes) {
  const StereoCalibration reported = hololens2_calibration();
  const Vec3 forward{0.0, 0.0, 0.5};
  const auto middle = reported.left.project(forward);
  ASSERT_TRUE(middle.has_value());
  ErrorModel only_centre = ErrorModel::perfect();
  only_centre.calibration_centre_px = 0.3;
  ErrorModel only_rig = ErrorModel::perfect();
  only_rig.calibration_rotation_rad = 0.0008;
  only_rig.calibration_baseline_m = 0.0002;
  double centre = 0.0;
  double rotation = 0.0;
  double translation = 0.0;
  constexpr int kSeeds = 40;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto moved = perturbed(reported, only_centre, Random(seed));
    ASSERT_TRUE(moved.ok());
    const auto pixel = moved->left.project(forward);
    ASSERT_TRUE(pixel.has_value());
    centre += (*pixel - *middle).dot(*pixel - *middle);
    const auto erring = perturbed(reported, only_rig, Random(seed));
    ASSERT_TRUE(erring.ok());
    rotation += std::pow(
        rotation_angle_rad(erring->right_from_rig.rotation(), reported.right_from_rig.rotation()),
        2);
    translation += (erring->right_from_rig.inverse().translation() -
                    reported.right_from_rig.inverse().translation())
                       .squared_norm();
  }
  // Four standard errors of an SD from 40 draws of two or three axes.
  EXPECT_NEAR(std::sqrt(centre / kSeeds / 2), 0.3, 0.1);
  EXPECT_NEAR(std::sqrt(rotation / kSeeds / 3), 0.0008, 0.00021);
  EXPECT_NEAR(std::sqrt(translation / kSeeds / 3), 0.0002, 0.000052);
}

TEST(PerturbedCalibration, ZoomMovesTheEdgeAndKeepsTheMiddle) {
  const StereoCalibration reported = hololens2_calibration();
  ErrorModel zoom = ErrorModel::perfect();
  zoom.calibration_focal_ratio = 0.01;
  const auto actual = perturbed(reported, zoom, Random(3));
  ASSERT_TRUE(actual.ok());
  const auto middle_before = reported.left.project(Vec3{0, 0, 1});
  const auto middle_after = actual->left.project(Vec3{0, 0, 1});
  const auto edge_before = reported.left.project(Vec3{0.5, 0, 1});
  const auto edge_after = actual->left.project(Vec3{0.5, 0, 1});
  ASSERT_TRUE(middle_before && middle_after && edge_before && edge_after);
  EXPECT_LT((*middle_after - *middle_before).norm(), 1e-4);
  EXPECT_GT((*edge_after - *edge_before).norm(), 0.1);
}

TEST(DescribedTools, AreAsTheyWereMadeInAPerfectWorld) {
  const auto tools = described(test_tools(), ErrorModel::perfect(), Random(1));
  ASSERT_EQ(tools.size(), 2U);
  EXPECT_EQ(tools[0].tip_in_marker, test_tools()[0].tip_in_marker);
  EXPECT_EQ(tools[1].axis_in_marker, test_tools()[1].axis_in_marker);
}

TEST(DescribedTools, AreOffByTheirMagnitudes) {
  double tip = 0.0;
  double axis = 0.0;
  constexpr int kSeeds = 400;
  const RoomTool made = test_tools()[1];
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const RoomTool told = described(test_tools(), ErrorModel{}, Random(seed))[1];
    tip += (told.tip_in_marker - made.tip_in_marker).squared_norm();
    axis += std::pow(angle_between_rad(told.axis_in_marker, made.axis_in_marker), 2);
  }
  // SD an axis, three for the tip, two for a direction; five standard errors.
  EXPECT_NEAR(std::sqrt(tip / kSeeds / 3), ErrorModel{}.tip_calibration_m, 0.00006);
  EXPECT_NEAR(std::sqrt(axis / kSeeds / 2), ErrorModel{}.axis_calibration_rad, 0.0004);
}

}  // namespace
}  // namespace orthonav::sim
