// Pairs whose two pictures are not of the same moment.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "tests/nav/tracking/best_tracking.h"

namespace orthonav::nav::tracking_best_test {
namespace {

/// The tags as a head sees them that sways by 5 cm and 6 degrees: at most 0.1 m and 0.2 rad a
/// second. The pointer moves as well, the guide rests.
std::vector<test::PlacedTag> tags_seen(double t_s, double sway) {
  auto tags = tags_at(0);
  tags[0].rig_from_marker =
      test::facing({0.03 * std::sin(2.0 * t_s), 0.04 + 0.02 * std::cos(3.0 * t_s), 0.0},
                   {0.3, -0.3 + 0.2 * std::sin(t_s), 0.2 + t_s});
  const Transform<Rig, Rig> head(
      rotation_from_vector(sway * Vec3{0.1 * std::sin(1.9 * t_s), 0.05 * std::sin(2.3 * t_s), 0.0}),
      sway * Vec3{0.05 * std::sin(2.0 * t_s), 0.03 * std::cos(1.7 * t_s), 0.02 * std::sin(t_s)});
  for (test::PlacedTag& tag : tags) {
    tag.rig_from_marker = head * tag.rig_from_marker;
  }
  return tags;
}

struct PicturesRun {
  std::int64_t refused = 0;
  std::int64_t in_a_row = 0;
  int measured = 0;      ///< sightings of the guide
  double worst_m = 0.0;  ///< of the guide's tip, where it was measured
};

/// Tracks with the right pictures this much too old from the twentieth pair on.
PicturesRun tracked_pictures(int pairs, double late_s, double noise_grey, Vec3 turned_rad,
                             double sway = 1.0) {
  const StereoCalibration truth = test::test_calibration();
  StereoCalibration reported = truth;
  rotate_right_camera(reported, turned_rad);
  auto tracker =
      create_photometric_tracker(reported, {tool("pointer", 3, 0.05), tool("guide", 5, 0.07)});
  EXPECT_TRUE(tracker.ok());
  Random random(7);
  PicturesRun run;
  for (int k = 0; k < pairs; ++k) {
    const double t_s = 0.033 * k;
    StereoFrame frame = test::stereo_frame(truth, tags_seen(t_s, sway), at(k));
    if (late_s > 0.0 && k >= 20) {
      frame.right = test::stereo_frame(truth, tags_seen(t_s - late_s, sway), at(k)).right;
    }
    for (GreyImage* image : {&frame.left, &frame.right}) {
      for (std::uint8_t& pixel : image->pixels) {
        pixel = static_cast<std::uint8_t>(
            std::clamp(std::lround(pixel + noise_grey * random.normal()), 0L, 255L));
      }
    }
    frame.world_from_rig = Transform<World, Rig>{};
    const auto states = (*tracker)->track(frame);
    if (states[1].world_from_marker.status == PoseStatus::kMeasured) {
      ++run.measured;
      run.worst_m = std::max(run.worst_m, tip_error_m(states[1], tags_seen(t_s, sway)[1]));
    }
  }
  run.refused = (*tracker)->picture_agreement().refused;
  run.in_a_row = (*tracker)->picture_agreement().refused_in_a_row;
  return run;
}

TEST(Pictures, OfDifferentMomentsAreRefusedWhileTheHeadMoves) {
  const PicturesRun late = tracked_pictures(36, 0.033, 1.0, {});
  EXPECT_EQ(late.refused, 16);
  EXPECT_EQ(late.measured, 20);
  EXPECT_LT(late.worst_m, 0.002);
  EXPECT_GT(late.in_a_row, 3);
}

TEST(Pictures, OfOneMomentAreTakenFromAMovingHead) {
  const PicturesRun clean = tracked_pictures(25, 0.0, 1.0, {});
  EXPECT_EQ(clean.refused, 0);
  EXPECT_EQ(clean.measured, 25);
}

TEST(Pictures, OfAnyMomentAreTakenWhileNothingMoves) {
  const StereoCalibration calibration = test::test_calibration();
  Tracking t;
  for (int k = 0; k < 10; ++k) {
    StereoFrame frame = test::stereo_frame(calibration, tags_at(0), at(k));
    frame.world_from_rig = Transform<World, Rig>{};
    EXPECT_EQ(t.tracker->track(frame)[1].world_from_marker.status, PoseStatus::kMeasured);
  }
  EXPECT_EQ(t.tracker->picture_agreement().refused, 0);
}

/// What a real unit was off by, and more noise than a headset's cameras have.
TEST(Pictures, OfCamerasThatAreTurnedOrNoisyAreTaken) {
  EXPECT_EQ(tracked_pictures(25, 0.0, 4.0, {0.0014, -0.0008, 0.0012}).refused, 0);
}

}  // namespace
}  // namespace orthonav::nav::tracking_best_test
