#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/fake/scripted.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/depth_scene.h"

namespace orthonav::replay::depth_pace_test {
namespace {

using orthonav::test::DepthScene;
using orthonav::test::StreamRecorderFolder;
using ::testing::ElementsAre;

constexpr std::int64_t kFrame = 333'333;

/// Two pairs a frame apart, and depth before, between and after them.
struct PacedRecording {
  PacedRecording() {
    DepthScene scene;
    scene.pictures = DepthScene::located({-200'000, 100'000, 200'000, 400'000, 500'000});
    scene.write_stream_recorder(folder.path(), "Depth AHaT");
  }
  StreamRecorderFolder folder{{0, kFrame}, {0, kFrame}};
};

/// By the stamps in the files, whose names the headset then gives to depth too.
std::unique_ptr<ReplayHeadset> opened(const PacedRecording& recording, ReplayOptions options = {}) {
  options.stamps = RecordedStamps::kExact;
  auto headset = ReplayHeadset::open(recording.folder.path(), options);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  return headset ? std::move(*headset) : nullptr;
}

/// Ticks after the start of what a depth camera has now; checks that none lies ahead of the clock.
std::vector<std::int64_t> taken(ReplayHeadset& headset) {
  std::vector<std::int64_t> ticks;
  DepthFrame frame;
  for (;;) {
    const auto next = headset.depth_cameras().front()->next(frame);
    EXPECT_TRUE(next.ok());
    if (!next || *next != Next::kFrame) {
      return ticks;
    }
    EXPECT_LE(frame.time, headset.clock().now()) << "out of the future";
    ticks.push_back(headset.file_ticks_100ns(frame.time) - StreamRecorderFolder::kStart);
  }
}

TEST(DepthPace, ComesWhenThePairsHaveBroughtTheClockThatFar) {
  const PacedRecording recording;
  const auto headset = opened(recording);
  ASSERT_NE(headset, nullptr);
  EXPECT_THAT(taken(*headset), ElementsAre());
  StereoFrame pair;
  ASSERT_EQ(*headset->cameras()->next(pair), Next::kFrame);
  EXPECT_THAT(taken(*headset), ElementsAre(-200'000));
  ASSERT_EQ(*headset->cameras()->next(pair), Next::kFrame);
  EXPECT_THAT(taken(*headset), ElementsAre(100'000, 200'000));
  ASSERT_EQ(*headset->cameras()->next(pair), Next::kEnd);
  EXPECT_THAT(taken(*headset), ElementsAre(400'000, 500'000));
  DepthFrame frame;
  EXPECT_EQ(*headset->depth_cameras().front()->next(frame), Next::kEnd);
}

TEST(DepthPace, WaitsForTheSteps) {
  const PacedRecording recording;
  const auto headset = opened(recording, {ReplayPace::kStepped, nullptr});
  ASSERT_NE(headset, nullptr);
  StereoFrame pair;
  EXPECT_EQ(*headset->cameras()->next(pair), Next::kNone);
  EXPECT_THAT(taken(*headset), ElementsAre());
  headset->step();
  EXPECT_EQ(*headset->cameras()->next(pair), Next::kFrame);
  EXPECT_THAT(taken(*headset), ElementsAre(-200'000));
  headset->step();
  EXPECT_EQ(*headset->cameras()->next(pair), Next::kFrame);
  EXPECT_THAT(taken(*headset), ElementsAre(100'000, 200'000));
  ASSERT_EQ(*headset->cameras()->next(pair), Next::kEnd);
  EXPECT_THAT(taken(*headset), ElementsAre(400'000, 500'000));
}

TEST(DepthPace, FollowsTheWallInRealTimeAndMissesWhatNobodyAskedFor) {
  const PacedRecording recording;
  fake::ManualClock wall;
  const auto headset = opened(recording, {ReplayPace::kRealtime, &wall});
  ASSERT_NE(headset, nullptr);
  // The clock starts a nominal frame, 333'333 ticks, before the first pair.
  EXPECT_THAT(taken(*headset), ElementsAre());
  wall.advance(std::chrono::milliseconds(14));
  EXPECT_THAT(taken(*headset), ElementsAre(-200'000));
  EXPECT_THAT(taken(*headset), ElementsAre()) << "never twice";
  wall.advance(std::chrono::milliseconds(40));
  EXPECT_THAT(taken(*headset), ElementsAre(200'000)) << "the newest of two";
  wall.advance(std::chrono::milliseconds(20));
  EXPECT_THAT(taken(*headset), ElementsAre(400'000));
  wall.advance(std::chrono::milliseconds(100));
  EXPECT_THAT(taken(*headset), ElementsAre(500'000));
  DepthFrame frame;
  EXPECT_EQ(*headset->depth_cameras().front()->next(frame), Next::kEnd);
}

}  // namespace
}  // namespace orthonav::replay::depth_pace_test
