// Where the tracker `paper` looks for tags, and which of those it finds it takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/nav/published/paper_tracking.h"

namespace orthonav::nav::tracking_paper_test {
namespace {

TEST(PaperTracker, BoxesGiveTheSameAsTheWholeImage) {
  auto whole = tracker();
  auto boxes = tracker({.full_search_interval = 10});
  for (const StereoFrame& frame : stroke()) {
    const auto a = whole->track(frame);
    const auto b = boxes->track(frame);
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_EQ(b[i].world_from_marker.status, PoseStatus::kMeasured);
      // 1e-3 px, the detector's promise, is 1 µm and 0.05 mrad here.
      EXPECT_LT((a[i].rig_from_marker.translation() - b[i].rig_from_marker.translation()).norm(),
                1e-5);
      EXPECT_LT(
          rotation_angle_rad(a[i].rig_from_marker.rotation(), b[i].rig_from_marker.rotation()),
          5e-4);
    }
  }
}

TEST(PaperTracker, LooksForMissingToolsEveryNthPairOnly) {
  auto t = tracker({.full_search_interval = 4});
  const StereoFrame pointer_only = frame_at(0, {pointer_at(0)});
  const StereoFrame both = frame_at(0, {pointer_at(0), guide_at(0)});
  std::vector<bool> guide_seen;
  for (int k = 0; k < 9; ++k) {
    const auto states = t->track(shown(k == 0 ? pointer_only : both, k));
    EXPECT_EQ(states[0].world_from_marker.status, PoseStatus::kMeasured) << k;
    guide_seen.push_back(states[1].world_from_marker.status == PoseStatus::kMeasured);
  }
  EXPECT_THAT(guide_seen,
              ::testing::ElementsAre(false, false, false, false, true, true, true, true, true));
}

TEST(PaperTracker, LooksEverywhereAtOnceAfterAGap) {
  auto t = tracker({.full_search_interval = 1000});
  (void)t->track(shown(stroke()[0], 0));
  (void)t->track(shown(stroke()[0], 1));
  for (const ToolState& state : t->track(shown(stroke()[5], 40))) {
    EXPECT_EQ(state.world_from_marker.status, PoseStatus::kMeasured);
  }
}

TEST(PaperTracker, FindsAToolAgainThatJumped) {
  auto t = tracker({.full_search_interval = 3});
  for (int k = 0; k < 6; ++k) {
    (void)t->track(shown(stroke()[0], k));
  }
  PlacedTag elsewhere = pointer_at(0);
  elsewhere.rig_from_marker = test::facing({-0.03, 0.12, -0.05}, {-0.2, 0.3, 0.5});
  const StereoFrame jumped = frame_at(0, {elsewhere, guide_at(0)});
  int found_after = -1;
  for (int k = 6; k < 12 && found_after < 0; ++k) {
    const ToolState state = t->track(shown(jumped, k))[0];
    if (state.world_from_marker.status != PoseStatus::kMeasured) {
      continue;
    }
    found_after = k - 6;
    EXPECT_LT(
        (state.rig_from_marker.translation() - elsewhere.rig_from_marker.translation()).norm(),
        kPoseM);
  }
  EXPECT_GE(found_after, 0);
  EXPECT_LE(found_after, 3);
}

TEST(PaperTracker, RejectsATagOfTheWrongSize) {
  PlacedTag tag = pointer_at(0);
  for (const auto& [size_m, origin] : {std::pair{0.05, PoseStatus::kMeasured},
                                       {0.05 * 1.12, PoseStatus::kMeasured},
                                       {0.05 * 1.18, PoseStatus::kLost},
                                       {0.05 * 0.8, PoseStatus::kLost}}) {
    tag.size_m = size_m;
    EXPECT_EQ(tracker()->track(frame_at(0, {tag}))[0].world_from_marker.status, origin) << size_m;
  }
}

TEST(PaperTracker, TakesThePairThatFitsWhenAnIdIsSeenTwice) {
  // A copy of twice the size: whichever way it is paired, size or epipolar line give it away.
  PlacedTag copy{"tag36h11", 3, 0.1, test::facing({-0.03, -0.1, 0.0}, {0.1, 0.2, 0.0})};
  const StereoFrame frame = frame_at(0, {pointer_at(0), copy});
  const ToolState state = tracker()->track(frame)[0];
  ASSERT_EQ(state.world_from_marker.status, PoseStatus::kMeasured);
  EXPECT_LT(
      (state.rig_from_marker.translation() - pointer_at(0).rig_from_marker.translation()).norm(),
      kPoseM);
}

TEST(PaperTracker, StaysWithTheToolItFollowsWhenAnEqualCopyAppears) {
  PlacedTag copy = pointer_at(0);
  copy.rig_from_marker = test::facing({-0.03, -0.1, 0.1}, {0.0, 0.0, 0.0});  // nearer, sharper
  auto t = tracker();
  (void)t->track(frame_at(0, {pointer_at(0)}));
  const ToolState state = t->track(frame_at(1, {pointer_at(1), copy}))[0];
  ASSERT_EQ(state.world_from_marker.status, PoseStatus::kMeasured);
  EXPECT_LT(
      (state.rig_from_marker.translation() - pointer_at(1).rig_from_marker.translation()).norm(),
      2 * kPoseM);
}

TEST(PaperTracker, RejectsImagesThatDoNotBelongTogether) {
  // The right image shows the tag 30 mm away across the epipolar lines.
  StereoFrame frame = frame_at(0, {pointer_at(0)});
  PlacedTag other = pointer_at(0);
  other.rig_from_marker = {other.rig_from_marker.rotation(),
                           other.rig_from_marker.translation() + Vec3{0.0, 0.03, 0.0}};
  frame.right = frame_at(0, {other}).right;
  EXPECT_EQ(tracker()->track(frame)[0].world_from_marker.status, PoseStatus::kLost);
}

}  // namespace
}  // namespace orthonav::nav::tracking_paper_test
