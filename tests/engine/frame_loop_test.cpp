#include "engine/frame_loop.h"

#include <gmock/gmock.h>

#include "hal/fake/failing.h"
#include "hal/fake/scripted.h"
#include "hal/sim/hololens2.h"
#include "tests/engine/scripted_session.h"

namespace orthonav::engine {
namespace {

constexpr Duration kPair = std::chrono::microseconds(33333);
constexpr Timestamp kStart = from_ticks_100ns(100'000'000);

fake::Script pairs(int n) {
  fake::Script script;
  script.calibration = sim::hololens2_calibration();
  script.clock_start = kStart;
  script.display_latency = std::chrono::milliseconds(16);
  for (int i = 0; i < n; ++i) {
    StereoFrame frame;
    frame.sequence = i;
    frame.time = kStart + (i + 1) * kPair;
    frame.left = GreyImage(640, 480);
    frame.right = GreyImage(640, 480);
    frame.world_from_rig = Transform<World, Rig>{};
    script.camera.push_back(frame);
    script.head.push_back({frame.time, {}});
  }
  return script;
}

std::unique_ptr<Session> session() {
  return Session::create(testing::operation_of({"L5"}),
                         std::make_unique<testing::ScriptedTracker>(),
                         [](const nav::VertebraModel&, std::span<const Point<World>>)
                             -> Result<nav::Registration> { return Error{"none"}; })
      .value();
}

class CountingSink : public SnapshotSink {
 public:
  Status draw(const Snapshot& snapshot) override {
    frames.push_back(snapshot.frame);
    if (fail_at >= 0 && snapshot.frame >= fail_at) return Error{"display unplugged"};
    return {};
  }
  std::vector<std::int64_t> frames;
  std::int64_t fail_at = -1;
};

TEST(FrameLoop, ShowsEveryPairAndEndsWithTheStream) {
  fake::FakeHeadset headset(pairs(10));
  const auto navigation = session();
  SceneBuilder builder;
  FrameLoop loop(headset, *navigation, builder, {});
  const auto report = loop.run();
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_EQ(report->displayed, 10);
  EXPECT_FALSE(report->done);
  EXPECT_EQ(headset.display().frames().size(), 10u);
  ASSERT_EQ(report->intervals_ms.size(), 9u);
  // The device's clock, exactly: 33.333 ms.
  EXPECT_NEAR(report->intervals_ms[0], 33.333, 1e-9);
}

TEST(FrameLoop, StopsAfterTheFramesAskedFor) {
  fake::FakeHeadset headset(pairs(10));
  const auto navigation = session();
  SceneBuilder builder;
  LoopOptions options;
  options.max_frames = 4;
  EXPECT_EQ(FrameLoop(headset, *navigation, builder, options).run()->displayed, 4);
}

TEST(FrameLoop, DrawsEveryNthFrameHoweverSlowTheSink) {
  fake::FakeHeadset headset(pairs(20));
  const auto navigation = session();
  SceneBuilder builder;
  LoopOptions options;
  options.draw_every = 3;
  CountingSink sink;
  FrameLoop loop(headset, *navigation, builder, options);
  loop.draw_into(&sink);
  const auto report = loop.run();
  ASSERT_TRUE(report.ok());
  EXPECT_THAT(sink.frames, ::testing::ElementsAre(0, 3, 6, 9, 12, 15, 18));
  EXPECT_EQ(report->drawn, 7);
}

TEST(FrameLoop, AFailingSinkIsReportedAndDoesNotHoldUpTracking) {
  fake::FakeHeadset headset(pairs(20));
  const auto navigation = session();
  SceneBuilder builder;
  CountingSink sink;
  sink.fail_at = 2;
  FrameLoop loop(headset, *navigation, builder, {});
  loop.draw_into(&sink);
  const auto report = loop.run();
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().message, "display unplugged");
  EXPECT_EQ(headset.display().frames().size(), 20u);
}

TEST(FrameLoop, GoesOnAfterFailuresOfEveryDevice) {
  fake::Script script = pairs(20);
  script.voice.push_back({"start", 1.0, kStart + 5 * kPair});
  fake::FakeHeadset inner(std::move(script));
  fake::Faults faults;
  faults.camera = {{3, fake::CameraFault::kError}, {7, fake::CameraFault::kWrongSize}};
  faults.voice = {{0, fake::EventFault::kError}};
  faults.display = {{9, fake::DisplayFault::kError}};
  fake::FailingHeadset headset(inner, faults);
  const auto navigation = session();
  SceneBuilder builder;
  const auto report = FrameLoop(headset, *navigation, builder, {}).run();
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_EQ(report->failures, 4);
  EXPECT_FALSE(report->last_failure.empty());
  EXPECT_EQ(navigation->current_step(), Step::kDigitize) << "the phrase came with the next poll";
}

TEST(FrameLoop, GivesUpOnADeviceThatFailsForGood) {
  fake::Script script = pairs(0);
  for (int i = 0; i < 100; ++i) script.camera.push_back(Error{"cable"});
  fake::FakeHeadset headset(std::move(script));
  const auto navigation = session();
  SceneBuilder builder;
  LoopOptions options;
  options.max_errors_in_a_row = 5;
  const auto report = FrameLoop(headset, *navigation, builder, options).run();
  ASSERT_FALSE(report.ok());
  EXPECT_THAT(report.error().message, ::testing::HasSubstr("6 failures in a row (limit 5): "));
  EXPECT_THAT(report.error().message, ::testing::HasSubstr("cable"));
}

TEST(SnapshotQueue, KeepsTheNewestWhenTheDrawerIsLate) {
  SnapshotQueue queue(SnapshotQueue::WhenFull::kDropOldest);
  for (std::int64_t i = 0; i < 10; ++i) {
    Snapshot* snapshot = queue.acquire();
    ASSERT_NE(snapshot, nullptr);
    snapshot->frame = i;
    queue.publish(snapshot);
  }
  EXPECT_EQ(queue.dropped(), 10 - static_cast<std::int64_t>(SnapshotQueue::kSlots));
  queue.close();
  std::vector<std::int64_t> left;
  while (Snapshot* snapshot = queue.take()) {
    left.push_back(snapshot->frame);
    queue.release(snapshot);
  }
  EXPECT_THAT(left, ::testing::ElementsAre(6, 7, 8, 9));
  EXPECT_EQ(queue.acquire(), nullptr) << "closed";
}

}  // namespace
}  // namespace orthonav::engine
