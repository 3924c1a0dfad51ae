// The tracker `best` on tools that are lost, hidden in part, or mistaken, and found again.
#include <gtest/gtest.h>

#include "tests/nav/tracking/best_tracking.h"

namespace orthonav::nav::tracking_best_test {
namespace {

TEST(BestTracker, PredictsNothingFromAnotherMapAndFindsAgain) {
  for (const std::int64_t epoch : {0, 1}) {
    Tracking t;
    for (int k = 0; k < 5; ++k) {
      t.tracker->track(t.frame(k));
    }
    StereoFrame hidden = t.frame(5);
    hide(hidden.left);
    hide(hidden.right);
    hidden.map_epoch = epoch;
    EXPECT_EQ(t.tracker->track(hidden)[0].world_from_marker.status,
              epoch == 0 ? PoseStatus::kPredicted : PoseStatus::kLost);
    int needed = 0;
    for (PoseStatus status = PoseStatus::kLost; status != PoseStatus::kMeasured; ++needed) {
      ASSERT_LT(needed, 4);
      StereoFrame frame = t.frame(6 + needed);
      frame.map_epoch = epoch;
      status = t.tracker->track(frame)[0].world_from_marker.status;
    }
  }
}

TEST(BestTracker, PredictsThenLosesAndFindsAgainAtOnce) {
  Tracking t;
  for (int k = 0; k < 5; ++k) {
    t.tracker->track(t.frame(k));
  }
  for (int k = 5; k < 14; ++k) {
    StereoFrame frame = t.frame(k);
    hide(frame.left);
    hide(frame.right);
    const PoseStatus status = t.tracker->track(frame)[0].world_from_marker.status;
    EXPECT_EQ(status, k < 8 ? PoseStatus::kPredicted : PoseStatus::kLost) << "pair " << k;
  }
  int needed = 0;
  while (t.tracker->track(t.frame(14 + needed))[0].world_from_marker.status !=
         PoseStatus::kMeasured) {
    ASSERT_LT(++needed, 3);
  }
  EXPECT_LT(tip_error_m(t.tracker->track(t.frame(15 + needed))[0], tags_at(15 + needed)[0]),
            2 * kTipM);
}

TEST(BestTracker, FindsAToolWhoseBorderOneCameraSeesOnlyInPart) {
  Tracking t;
  StereoFrame frame = t.frame(0);
  const auto corners = test::left_corners(t.calibration, tags_at(0)[0]);
  // A patch over one corner of the tag: no square there for a detector.
  for (int y = -5; y <= 5; ++y) {
    for (int x = -5; x <= 5; ++x) {
      frame.left.at(static_cast<int>(corners[0].x) + x, static_cast<int>(corners[0].y) + y) = 130;
    }
  }
  const auto states = t.tracker->track(frame);
  ASSERT_EQ(states[0].world_from_marker.status, PoseStatus::kMeasured);
  EXPECT_EQ(states[0].cameras, 2);
  EXPECT_LT(tip_error_m(states[0], tags_at(0)[0]), 4 * kTipM);
}

TEST(BestTracker, DoesNotFindAToolThatOnlyOneCameraSees) {
  Tracking t;
  StereoFrame frame = t.frame(0);
  hide(frame.right);
  EXPECT_NE(t.tracker->track(frame)[0].world_from_marker.status, PoseStatus::kMeasured);
}

TEST(BestTracker, DoesNotTakeOneTagForAnother) {
  // The pointer's place is taken by a tag of another tool between two pairs.
  Tracking t;
  for (int k = 0; k < 5; ++k) {
    t.tracker->track(t.frame(k));
  }
  auto tags = tags_at(5);
  tags[0].id = 11;
  StereoFrame frame = test::stereo_frame(t.calibration, tags, at(5));
  frame.world_from_rig = Transform<World, Rig>{};
  EXPECT_NE(t.tracker->track(frame)[0].world_from_marker.status, PoseStatus::kMeasured);
}

TEST(BestTracker, MeasuresNothingWithoutAHeadPose) {
  Tracking t;
  t.tracker->track(t.frame(0));
  StereoFrame frame = t.frame(1);
  frame.world_from_rig.reset();
  EXPECT_EQ(t.tracker->track(frame)[0].world_from_marker.status, PoseStatus::kLost);
  EXPECT_EQ(t.tracker->track(t.frame(2))[0].world_from_marker.status, PoseStatus::kMeasured);
}

TEST(BestTracker, TakesAFrameOfNoImageForNoTag) {
  Tracking t;
  t.tracker->track(t.frame(0));
  StereoFrame frame = t.frame(1);
  frame.left = {};
  frame.right = {};
  EXPECT_NE(t.tracker->track(frame)[0].world_from_marker.status, PoseStatus::kMeasured);
}

}  // namespace
}  // namespace orthonav::nav::tracking_best_test
