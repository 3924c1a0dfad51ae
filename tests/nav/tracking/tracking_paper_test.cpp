#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "nav/tracking/tag_matching.h"
#include "nav/tracking/tag_pose.h"
#include "nav/tracking/tool_tracker.h"
#include "tests/support/allocation_count.h"
#include "tests/support/tag_scene.h"

namespace orthonav::nav::tracking_paper_test {
namespace {

using test::PlacedTag;
using ::testing::HasSubstr;

// What the library's corners of a noise-free picture leave at 0.4 m: 0.05 px RMS are 0.1 mm in
// depth of a corner and 0.4° of tilt of a 50 mm tag; three SD.
constexpr double kPoseM = 0.0003;
constexpr double kPoseRad = 0.02;
constexpr int kFrameMs = 33;

const StereoCalibration& calibration() {
  static const StereoCalibration made = test::test_calibration();
  return made;
}

ToolGeometry tool(const std::string& name, int id, double size_m) {
  ToolGeometry made{name, ToolRole::kPointer, {"tag36h11", id, size_m}, {}, {}};
  made.tip_in_marker = {{0, -0.15, 0}};
  made.axis_in_marker = {{0, 1, 0}};
  return made;
}

std::vector<ToolGeometry> two_tools() { return {tool("pointer", 3, 0.05), tool("guide", 5, 0.07)}; }

std::unique_ptr<ToolTracker> tracker(const TrackerOptions& options = {},
                                     std::vector<ToolGeometry> tools = two_tools()) {
  auto made = create_corner_tracker(calibration(), std::move(tools), options);
  if (!made) {
    throw std::runtime_error(made.error().message);
  }
  return std::move(made).value();
}

std::string refusal(const TrackerOptions& options, std::vector<ToolGeometry> tools = two_tools(),
                    const StereoCalibration& cameras = calibration()) {
  auto made = create_corner_tracker(cameras, std::move(tools), options);
  return made ? "" : made.error().message;
}

Timestamp at_frame(int k) { return Timestamp(std::chrono::milliseconds(kFrameMs * k)); }

PlacedTag pointer_at(int k) {
  return {"tag36h11", 3, 0.05,
          test::facing({0.002 * k, 0.04 + 0.001 * k, 0.0}, {0.3 + 0.01 * k, -0.3, 0.2})};
}

PlacedTag guide_at(int k) {
  return {"tag36h11", 5, 0.07, test::facing({-0.05, -0.06, 0.05}, {-0.2, 0.3 + 0.01 * k, 1.6})};
}

StereoFrame frame_at(int k, const std::vector<PlacedTag>& tags) {
  StereoFrame frame = test::stereo_frame(calibration(), tags, at_frame(k));
  frame.sequence = k;
  return frame;
}

// A short stroke of both tools, rendered once.
const std::vector<StereoFrame>& stroke() {
  static const std::vector<StereoFrame> frames = [] {
    std::vector<StereoFrame> made;
    for (int k = 0; k < 6; ++k) {
      made.push_back(frame_at(k, {pointer_at(k), guide_at(k)}));
    }
    return made;
  }();
  return frames;
}

StereoFrame shown(const StereoFrame& frame, int k) {
  StereoFrame out = frame;
  out.time = at_frame(k);
  return out;
}

void blind(GreyImage& image) { std::fill(image.pixels.begin(), image.pixels.end(), 90); }

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

TEST(PaperTracker, SurvivesTimeStandingStill) {
  auto t = tracker({.full_search_interval = 10});
  (void)t->track(stroke()[0]);
  for (int k = 0; k < 3; ++k) {
    for (const ToolState& state : t->track(stroke()[0])) {
      EXPECT_TRUE(std::isfinite(state.world_from_marker.covariance[0]));
      if (state.world_from_marker.status == PoseStatus::kLost) {
        continue;
      }
      EXPECT_TRUE(state.world_from_marker.value.translation().is_finite());
    }
  }
}

TEST(PaperTracker, RefusesBadToolsOptionsAndCameras) {
  EXPECT_EQ(refusal({}), "");
  EXPECT_THAT(refusal({}, {tool("pointer", 3, 0.05), tool("guide", 3, 0.07)}),
              HasSubstr("already on tool 'pointer'"));
  EXPECT_THAT(refusal({}, {}), HasSubstr("no tools"));
  EXPECT_THAT(refusal({.full_search_interval = 0}), HasSubstr("full_search_interval 0"));
  EXPECT_THAT(refusal({.decimate = 7}), HasSubstr("decimate"));
  EXPECT_THAT(refusal({.coast = std::chrono::milliseconds(-1)}), HasSubstr("coast"));
  EXPECT_THAT(refusal({.corner_acceleration_px2_per_s3 = 0}),
              HasSubstr("corner_acceleration_px2_per_s3"));
  EXPECT_THAT(refusal({.corner_noise_px = std::nan("")}), HasSubstr("corner_noise_px"));
  EXPECT_THAT(refusal({}, two_tools(), {}), HasSubstr("no camera model"));
}

TEST(TagGeometry, RecoversThePoseOfExactCorners) {
  const TagGeometry geometry(calibration());
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const PlacedTag tag{
        "tag36h11", 3, 0.05,
        test::facing(
            {random.uniform(-0.05, 0.05), random.uniform(-0.08, 0.08), random.uniform(-0.2, 0.1)},
            {random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), random.uniform(-3, 3)})};
    const TagPair seen{left_corners(calibration(), tag), right_corners(calibration(), tag)};
    const auto pose = geometry.pose(seen, tag.size_m);
    ASSERT_TRUE(pose);
    // Corners invert to 1e-6 px.
    EXPECT_LT((pose->rig_from_marker.translation() - tag.rig_from_marker.translation()).norm(),
              1e-7);
    EXPECT_LT(rotation_angle_rad(pose->rig_from_marker.rotation(), tag.rig_from_marker.rotation()),
              1e-5);
    EXPECT_NEAR(pose->size_ratio, 1.0, 1e-6);
    EXPECT_LT(pose->gap_px, 1e-4);
    EXPECT_LT(geometry.residual_px(pose->rig_from_marker, seen, tag.size_m).value(), 1e-4);
  }
}

TEST(TagGeometry, NeedsEveryCorner) {
  const TagGeometry geometry(calibration());
  const PlacedTag tag = pointer_at(0);
  TagPair seen{left_corners(calibration(), tag), right_corners(calibration(), tag)};
  seen.right_px[2] = {-50, 20};
  EXPECT_FALSE(geometry.pose(seen, 0.05));
  seen.right_px[2] = {std::numeric_limits<double>::quiet_NaN(), 20};
  EXPECT_FALSE(geometry.pose(seen, 0.05));
}

TEST(TagGeometry, CovarianceMatchesWhatCornerNoiseDoes) {
  const TagGeometry geometry(calibration());
  constexpr double kNoisePx = 0.05;
  Random random(8);
  const PlacedTag tag = pointer_at(0);
  const TagPair exact{left_corners(calibration(), tag), right_corners(calibration(), tag)};
  const auto claimed = geometry.covariance(tag.rig_from_marker, exact, tag.size_m,
                                           kNoisePx * kNoisePx, kNoisePx * kNoisePx);
  ASSERT_TRUE(claimed);
  std::array<double, 6> squared{};
  constexpr int kDraws = 2000;
  for (int draw = 0; draw < kDraws; ++draw) {
    TagPair seen = exact;
    for (auto* corners : {&seen.left_px, &seen.right_px}) {
      for (Vec2& c : *corners) {
        c = c + Vec2{random.normal(0, kNoisePx), random.normal(0, kNoisePx)};
      }
    }
    const auto pose = geometry.pose(seen, tag.size_m);
    ASSERT_TRUE(pose);
    const Vec3 shift = pose->rig_from_marker.translation() - tag.rig_from_marker.translation();
    const Vec3 turn = vector_from_rotation(pose->rig_from_marker.rotation() *
                                           tag.rig_from_marker.rotation().transposed());
    for (int i = 0; i < 3; ++i) {
      squared[static_cast<std::size_t>(i)] += shift[i] * shift[i] / kDraws;
      squared[static_cast<std::size_t>(i + 3)] += turn[i] * turn[i] / kDraws;
    }
  }
  // 2000 draws know a variance to 3 % (1 SD); to first order only, so 15 %.
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(squared[i] / (*claimed)[7 * i], 1.0, 0.15) << i;
  }
}

TEST(TagGeometry, TurnedCovarianceIsThatOfTheTurnedPose) {
  PoseCovariance covariance{};
  covariance[0] = 4.0;   // along x
  covariance[35] = 9.0;  // about z
  const Mat3 quarter = {{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}};
  const PoseCovariance seen = turned(covariance, quarter);
  EXPECT_NEAR(seen[0], 0.0, 1e-12);
  EXPECT_NEAR(seen[7], 4.0, 1e-12);
  EXPECT_NEAR(seen[35], 9.0, 1e-12);
}

}  // namespace
}  // namespace orthonav::nav::tracking_paper_test
