#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "tests/hal/sim/hovering_headset.h"

namespace orthonav::sim::sim_headset_test {
namespace {

TEST(SimHeadset, PerfectHeadPoseIsTheTruth) {
  SimOptions options = hovering();
  options.error_model = ErrorModel::perfect();
  const auto headset = opened(options);
  for (int i = 0; i < 5; ++i) {
    const StereoFrame frame = next_frame(*headset);
    ASSERT_TRUE(frame.world_from_rig.has_value());
    const auto truth = headset->world_from_room() * headset->state().room_from_rig;
    EXPECT_LT((frame.world_from_rig->translation() - truth.translation()).norm(), 1e-9);
    EXPECT_LT(rotation_angle_rad(frame.world_from_rig->rotation(), truth.rotation()), 1e-9);
  }
}

TEST(SimHeadset, ReportedHeadPoseHasTheNoiseOfItsMagnitudes) {
  SimOptions options = hovering();
  options.error_model.head_pose_noise_m = 0.001;
  options.error_model.head_pose_noise_rad = 0.002;
  const auto headset = opened(options);
  double translation = 0.0;
  double rotation = 0.0;
  constexpr int kFrames = 3000;
  for (int i = 0; i < kFrames; ++i) {
    const StereoFrame frame = next_frame(*headset);
    const auto truth = headset->world_from_room() * headset->state().room_from_rig;
    translation += (frame.world_from_rig->translation() - truth.translation()).squared_norm();
    rotation += std::pow(rotation_angle_rad(frame.world_from_rig->rotation(), truth.rotation()), 2);
  }
  // Five standard errors of a variance from 9,000 draws: 5·sqrt(2/9000) = 7.5 %, half of it here.
  EXPECT_NEAR(std::sqrt(translation / kFrames / 3), 0.001, 0.00004);
  EXPECT_NEAR(std::sqrt(rotation / kFrames / 3), 0.002, 0.00008);
}

TEST(SimHeadset, TellsTheNoiseOfTheReportedHeadPoseApart) {
  SimOptions options = hovering();
  options.error_model.head_pose_noise_m = 0.001;
  options.error_model.head_pose_noise_rad = 0.002;
  const auto headset = opened(options);
  const StereoFrame first = next_frame(*headset);
  const auto true_first = headset->world_from_room() * headset->state().room_from_rig;
  for (int i = 0; i < 10; ++i) {
    next_frame(*headset);
  }
  const auto actual = headset->actual_from_reported(first.time) * *first.world_from_rig;
  EXPECT_GT((first.world_from_rig->translation() - true_first.translation()).norm(), 1e-5);
  EXPECT_LT((actual.translation() - true_first.translation()).norm(), 1e-9);
  EXPECT_LT(rotation_angle_rad(actual.rotation(), true_first.rotation()), 1e-9);
  const auto unknown = headset->actual_from_reported(first.time - std::chrono::hours(1));
  EXPECT_EQ(unknown.translation().norm(), 0.0);
}

TEST(SimHeadset, HeadSwaysAndMapDriftsByTheirMagnitudes) {
  SimOptions options = hovering();
  options.error_model.map_drift_m_per_sqrt_s = 0.001;
  const auto headset = opened(options);
  next_frame(*headset);
  const auto start = headset->world_from_room();
  Vec3 sum;
  double squares = 0.0;
  constexpr int kFrames = 6000;
  for (int i = 0; i < kFrames; ++i) {
    next_frame(*headset);
    const Vec3 head = headset->state().room_from_rig.translation();
    sum += head;
    squares += head.squared_norm();
  }
  const double variance = squares / kFrames - (sum / kFrames).squared_norm();
  // Sway in rotation turns about the point between the cameras and adds next to nothing.
  EXPECT_NEAR(std::sqrt(variance / 3), ErrorModel{}.head_sway_m, 0.003);
  // 200 s of a walk of 1 mm per root second and axis: 24 mm expected length.
  const double drift = (headset->world_from_room().translation() - start.translation()).norm();
  EXPECT_GT(drift, 0.004);
  EXPECT_LT(drift, 0.080);
}

TEST(SimHeadset, PredictsTheHeadFromItsVelocityAndLosesItBeyondItsReach) {
  SimOptions options = hovering();
  options.error_model.head_pose_noise_m = 0.0;
  options.error_model.head_pose_noise_rad = 0.0;
  const auto headset = opened(options);
  EXPECT_EQ(headset->head().world_from_rig(headset->clock().now()).status, PoseStatus::kLost);
  StereoFrame frame;
  for (int i = 0; i < 50; ++i) {
    frame = next_frame(*headset);
  }
  const Timestamp ahead = frame.time + (next_frame(*headset).time - frame.time);
  const auto predicted = headset->head().world_from_rig(ahead + std::chrono::milliseconds(33));
  EXPECT_EQ(predicted.status, PoseStatus::kPredicted);
  next_frame(*headset);
  const auto truth = headset->world_from_room() * headset->state().room_from_rig;
  // A swaying head is predicted over a frame within a tenth of a millimetre.
  EXPECT_LT((predicted.value.translation() - truth.translation()).norm(), 0.0001);
  EXPECT_EQ(headset->head().world_from_rig(frame.time).status, PoseStatus::kMeasured);
  EXPECT_EQ(headset->head().world_from_rig(ahead + std::chrono::milliseconds(200)).status,
            PoseStatus::kLost);
}

}  // namespace
}  // namespace orthonav::sim::sim_headset_test
