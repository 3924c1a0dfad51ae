// What the tracker `best` finds wrong with the calibration and with the sizes of the tags.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/nav/tracking/best_tracking.h"

namespace orthonav::nav::tracking_best_test {
namespace {

/// The worst tip late in a sequence of which the cameras are not as reported.
double worst_late_tip_m(const StereoCalibration& truth, const StereoCalibration& reported,
                        std::optional<StereoAlignment>& found) {
  auto tracker =
      create_photometric_tracker(reported, {tool("pointer", 3, 0.05), tool("guide", 5, 0.07)});
  EXPECT_TRUE(tracker.ok());
  double worst = 0.0;
  for (int k = 0; k < 60; ++k) {
    StereoFrame frame = test::stereo_frame(truth, tags_at(k), at(k));
    frame.world_from_rig = Transform<World, Rig>{};
    const auto states = (*tracker)->track(frame);
    for (std::size_t i = 0; i < 2 && k > 50; ++i) {
      worst = std::max(worst, tip_error_m(states[i], tags_at(k)[i]));
    }
  }
  found = (*tracker)->alignment();
  return worst;
}

TEST(BestTracker, FindsHowTheCamerasAreTurnedAgainstTheirCalibration) {
  const StereoCalibration truth = test::test_calibration();
  StereoCalibration reported = truth;
  // 0.7 px: what a real unit was off by.
  const Vec3 off{0.0014, -0.0008, 0.0012};
  reported.right_from_rig =
      Transform<RightCamera, RightCamera>(rotation_from_vector(-off), {}) * truth.right_from_rig;
  std::optional<StereoAlignment> found;
  const double worst = worst_late_tip_m(truth, reported, found);
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->applied);
  EXPECT_LT((found->rotation_rad - off).norm(), 0.0003);
  EXPECT_LT(worst, 0.001);
}

TEST(BestTracker, LeavesAGoodCalibrationAlone) {
  const StereoCalibration truth = test::test_calibration();
  std::optional<StereoAlignment> found;
  worst_late_tip_m(truth, truth, found);
  ASSERT_TRUE(found.has_value());
  EXPECT_FALSE(found->applied);
  EXPECT_LT(found->rotation_rad.norm(), 0.00015);
}

/// Tracks resting tags that were printed at `fraction` of their stated size.
std::unique_ptr<ToolTracker> tracked_at_size(double fraction, int pairs) {
  Tracking t;
  auto tags = tags_at(0);
  for (test::PlacedTag& tag : tags) {
    tag.size_m *= fraction;
  }
  StereoFrame frame = test::stereo_frame(t.calibration, tags, at(0));
  frame.world_from_rig = Transform<World, Rig>{};
  for (int k = 0; k < pairs; ++k) {
    frame.time = at(k);
    t.tracker->track(frame);
  }
  return std::move(t.tracker);
}

TEST(BestTracker, SaysThatTagsWerePrintedTooSmall) {
  const auto tracker = tracked_at_size(0.96, 40);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto size = tracker->tag_size(i);
    ASSERT_TRUE(size.has_value());
    EXPECT_TRUE(size->disagrees) << size->fraction << " SD " << size->sd << " of "
                                 << size->measurements;
    EXPECT_NEAR(size->fraction, -0.04, 0.004);
  }
  const auto alignment = tracker->alignment();
  EXPECT_FALSE(alignment && alignment->applied) << "a wrong print is no reason to turn a camera";
}

TEST(BestTracker, SaysThatTagsHaveAWrongUnitOrSize) {
  const auto tracker = tracked_at_size(0.75, 40);
  const auto size = tracker->tag_size(0);
  ASSERT_TRUE(size.has_value());
  EXPECT_TRUE(size->disagrees);
  EXPECT_NEAR(size->fraction, -0.25, 0.03);
}

TEST(BestTracker, HasNothingToSayOfTagsOfTheirStatedSize) {
  const auto tracker = tracked_at_size(1.0, 32);
  const auto size = tracker->tag_size(0);
  ASSERT_TRUE(size.has_value());
  EXPECT_FALSE(size->disagrees);
  EXPECT_NEAR(size->fraction, 0.0, 0.004);
}

}  // namespace
}  // namespace orthonav::nav::tracking_best_test
