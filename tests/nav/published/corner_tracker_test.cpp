// The tracker `paper`: its poses, and its results for pairs that show too little.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/nav/published/paper_tracking.h"
#include "tests/support/allocation_count.h"

namespace orthonav::nav::tracking_paper_test {
namespace {

using ::testing::HasSubstr;

TEST(PaperTracker, FindsPosesFromPixels) {
  auto t = tracker();
  for (int k = 0; k < 6; ++k) {
    const StereoFrame& frame = stroke()[static_cast<std::size_t>(k)];
    const auto states = t->track(frame);
    ASSERT_EQ(states.size(), 2u);
    for (const auto& [state, tag] :
         {std::pair{states[0], pointer_at(k)}, {states[1], guide_at(k)}}) {
      ASSERT_EQ(state.world_from_marker.status, PoseStatus::kMeasured)
          << tag.id << " in pair " << k;
      EXPECT_EQ(state.world_from_marker.time, frame.time);
      const auto truth = *frame.world_from_rig * tag.rig_from_marker;
      const auto& pose = state.world_from_marker.value;
      EXPECT_LT((pose.translation() - truth.translation()).norm(), kPoseM);
      EXPECT_LT(rotation_angle_rad(pose.rotation(), truth.rotation()), kPoseRad);
      EXPECT_LT((state.rig_from_marker.translation() - tag.rig_from_marker.translation()).norm(),
                kPoseM);
      EXPECT_LT(state.residual_px, 0.15);
      EXPECT_GT(state.world_from_marker.covariance[0], 0.0);
    }
  }
}

TEST(PaperTracker, PredictsThenLosesAToolThatOneCameraMisses) {
  for (const bool blind_left : {true, false}) {
    auto t = tracker();
    for (int k = 0; k < 4; ++k) {
      (void)t->track(stroke()[static_cast<std::size_t>(k)]);
    }
    std::vector<PoseStatus> origins;
    for (int k = 4; k < 9; ++k) {
      StereoFrame frame = shown(stroke()[4], k);
      blind(blind_left ? frame.left : frame.right);
      origins.push_back(t->track(frame)[0].world_from_marker.status);
    }
    // Coasting for 100 ms: three pairs of 33 ms after the last measured one.
    EXPECT_THAT(origins, ::testing::ElementsAre(PoseStatus::kPredicted, PoseStatus::kPredicted,
                                                PoseStatus::kPredicted, PoseStatus::kLost,
                                                PoseStatus::kLost));
    EXPECT_EQ(t->track(shown(stroke()[5], 9))[0].world_from_marker.status, PoseStatus::kMeasured);
  }
}

TEST(PaperTracker, PredictsNothingFromAnotherMap) {
  for (const std::int64_t epoch : {0, 1}) {
    auto t = tracker();
    for (int k = 0; k < 4; ++k) {
      (void)t->track(stroke()[static_cast<std::size_t>(k)]);
    }
    StereoFrame frame = stroke()[4];
    blind(frame.left);
    blind(frame.right);
    frame.map_epoch = epoch;
    EXPECT_EQ(t->track(frame)[0].world_from_marker.status,
              epoch == 0 ? PoseStatus::kPredicted : PoseStatus::kLost);
  }
}

TEST(PaperTracker, PredictsAlongTheMotion) {
  auto t = tracker();
  for (int k = 0; k < 5; ++k) {
    (void)t->track(stroke()[static_cast<std::size_t>(k)]);
  }
  StereoFrame frame = stroke()[5];
  blind(frame.left);
  blind(frame.right);
  const ToolState state = t->track(frame)[0];
  ASSERT_EQ(state.world_from_marker.status, PoseStatus::kPredicted);
  const auto truth = pointer_at(5).rig_from_marker;
  EXPECT_LT((state.rig_from_marker.translation() - truth.translation()).norm(), 2 * kPoseM);
  const auto last = pointer_at(4).rig_from_marker;
  EXPECT_GT((state.rig_from_marker.translation() - last.translation()).norm(), 5 * kPoseM);
}

TEST(PaperTracker, DoesNotMeasureWithoutTheHead) {
  auto t = tracker();
  (void)t->track(stroke()[0]);
  StereoFrame frame = stroke()[1];
  frame.world_from_rig.reset();
  for (const ToolState& state : t->track(frame)) {
    EXPECT_EQ(state.world_from_marker.status, PoseStatus::kLost);
  }
  EXPECT_EQ(t->track(stroke()[2])[0].world_from_marker.status, PoseStatus::kMeasured);
}

TEST(PaperTracker, GivesTheSameWithOneThreadAndTwo) {
  auto one = tracker({.parallel = false});
  auto two = tracker({.parallel = true});
  for (const StereoFrame& frame : stroke()) {
    const auto a = one->track(frame);
    const auto b = two->track(frame);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(a[i].world_from_marker.value, b[i].world_from_marker.value);
      EXPECT_EQ(a[i].world_from_marker.covariance, b[i].world_from_marker.covariance);
      EXPECT_EQ(a[i].residual_px, b[i].residual_px);
    }
  }
}

TEST(PaperTracker, AllocatesNothingOnceWarm) {
  for (const int interval : {1, 10}) {
    auto t = tracker({.full_search_interval = interval});
    StereoFrame frame = stroke()[0];
    for (int k = 0; k < 3; ++k) {
      frame.time = at_frame(k);
      (void)t->track(frame);
    }
    const std::size_t before = test::allocation_count();
    for (int k = 3; k < 8; ++k) {
      frame.time = at_frame(k);
      (void)t->track(frame);
    }
    EXPECT_EQ(test::allocation_count(), before);
  }
  const std::size_t before = test::allocation_count();
  const std::vector<int> one(1);  // the counter does count
  EXPECT_EQ(test::allocation_count(), before + one.size());
}

TEST(PaperTracker, SurvivesImagesThatAreNone) {
  auto t = tracker();
  (void)t->track(stroke()[0]);
  StereoFrame frame = stroke()[1];
  frame.left = GreyImage();
  frame.right.pixels.resize(7);
  EXPECT_EQ(t->track(frame)[0].world_from_marker.status, PoseStatus::kPredicted);
  StereoFrame small = stroke()[2];
  small.left = GreyImage(320, 240, 128);
  EXPECT_EQ(t->track(small)[0].world_from_marker.status, PoseStatus::kPredicted);
  EXPECT_EQ(t->track(stroke()[3])[0].world_from_marker.status, PoseStatus::kMeasured);
}

void expect_measured_at(const ToolState& state, const PlacedTag& tag) {
  ASSERT_EQ(state.world_from_marker.status, PoseStatus::kMeasured) << tag.id;
  const auto& pose = state.rig_from_marker;
  EXPECT_LT((pose.translation() - tag.rig_from_marker.translation()).norm(), kPoseM) << tag.id;
  EXPECT_LT(rotation_angle_rad(pose.rotation(), tag.rig_from_marker.rotation()), kPoseRad);
}

TEST(PaperTracker, SurvivesTimeStandingStill) {
  for (const int interval : {1, 10}) {
    auto t = tracker({.full_search_interval = interval});
    const auto states = t->track(stroke()[0]);
    const std::vector<ToolState> first(states.begin(), states.end());
    ASSERT_EQ(first.size(), 2u);
    // A pair that is shown again is the same measurement: no smoothing over zero seconds, and no
    // more certain for having been seen four times.
    for (int k = 0; k < 3; ++k) {
      const auto again = t->track(stroke()[0]);
      for (std::size_t i = 0; i < 2; ++i) {
        expect_measured_at(again[i], i == 0 ? pointer_at(0) : guide_at(0));
        EXPECT_EQ(again[i].world_from_marker.value, first[i].world_from_marker.value);
        EXPECT_EQ(again[i].world_from_marker.covariance, first[i].world_from_marker.covariance);
      }
    }
    // The control: with the clock still stopped, other pictures give another, correct pose.
    StereoFrame moved = shown(stroke()[1], 0);
    const ToolState other = t->track(moved)[0];
    expect_measured_at(other, pointer_at(1));
    EXPECT_GT((other.rig_from_marker.translation() - first[0].rig_from_marker.translation()).norm(),
              3 * kPoseM);
    // A velocity over zero seconds would throw the next boxes or the next prediction off.
    expect_measured_at(t->track(stroke()[2])[0], pointer_at(2));
    expect_measured_at(t->track(stroke()[3])[1], guide_at(3));
  }
}

std::string refusal(const TrackerOptions& options, std::vector<ToolGeometry> tools = two_tools(),
                    const StereoCalibration& cameras = calibration()) {
  auto made = published::create_corner_tracker(cameras, std::move(tools), options);
  return made ? "" : made.error().message;
}

TEST(PaperTracker, RefusesBadToolsOptionsAndCameras) {
  EXPECT_EQ(refusal({}), "");
  EXPECT_THAT(refusal({}, {tool("pointer", 3, 0.05), tool("guide", 3, 0.07)}),
              HasSubstr("already on tool 'pointer'"));
  EXPECT_THAT(refusal({}, {}), HasSubstr("no tools"));
  EXPECT_THAT(refusal({.full_search_interval = 0}), HasSubstr("full_search_interval 0"));
  EXPECT_THAT(refusal({.decimate = 7}), HasSubstr("decimate"));
  EXPECT_THAT(refusal({.coast = std::chrono::milliseconds(-1)}), HasSubstr("coast"));
  EXPECT_THAT(refusal({}, two_tools(), {}), HasSubstr("no camera model"));
}

}  // namespace
}  // namespace orthonav::nav::tracking_paper_test
