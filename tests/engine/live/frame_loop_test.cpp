#include "engine/live/frame_loop.h"

#include <gmock/gmock.h>

#include <thread>

#include "engine/session/text/wording.h"
#include "hal/api/forwarding_headset.h"
#include "hal/fake/failing.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/scripted_pairs.h"
#include "tests/support/shown_frames.h"

namespace orthonav::engine {
namespace {

using test::kPair;
using test::kStart;
using test::pairs;

std::unique_ptr<Session> session() {
  return Session::create(test::operation_of({"L5"}), std::make_unique<test::ScriptedTracker>(),
                         Method{"none",
                                {},
                                [](const RegistrationRequest&) -> Result<nav::Registration> {
                                  return Error{"none"};
                                }})
      .value();
}

class CountingSink : public SnapshotSink {
 public:
  Status draw(const Snapshot& snapshot) override {
    if (snapshot.blank) {
      return {};
    }
    frames.push_back(snapshot.frame);
    while (shown && shown->frames().size() < wait_for_shown) {
      std::this_thread::yield();
    }
    if (fail_at >= 0 && snapshot.frame >= fail_at) {
      return Error{"display unplugged"};
    }
    return {};
  }
  std::vector<std::int64_t> frames;
  std::int64_t fail_at = -1;
  /// Draws nothing before this many frames were shown.
  const test::ShownFrames* shown = nullptr;
  std::size_t wait_for_shown = 0;
};

TEST(FrameLoop, ShowsEveryPairAndEndsWithTheStream) {
  fake::FakeHeadset headset(pairs(10));
  const auto navigation = session();
  SceneBuilder builder;
  FrameLoop loop(headset, *navigation, builder, {});
  test::ShownFrames shown;
  loop.observe(&shown);
  const auto report = loop.run();
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.displayed, 10);
  EXPECT_FALSE(report.done);
  EXPECT_EQ(shown.frames().size(), 11u) << "and one that takes all back";
  ASSERT_EQ(report.intervals_ms.count(), 9);
  // The device's clock, exactly: 33.333 ms.
  EXPECT_NEAR(*report.intervals_ms.quantile(0.5), 33.333, 1e-9);
  ASSERT_EQ(report.photon_ages_ms.count(), 10);
  EXPECT_GT(*report.photon_ages_ms.quantile(0.0), 0.0);
}

TEST(FrameLoop, StopsAfterTheFramesAskedFor) {
  fake::FakeHeadset headset(pairs(10));
  const auto navigation = session();
  SceneBuilder builder;
  LoopOptions options;
  options.max_frames = 4;
  EXPECT_EQ(FrameLoop(headset, *navigation, builder, options).run().displayed, 4);
}

TEST(FrameLoop, StopsAfterTheTimeAskedFor) {
  fake::FakeHeadset headset(pairs(10));
  const auto navigation = session();
  SceneBuilder builder;
  LoopOptions options;
  options.max_time = std::chrono::milliseconds(99);  // three intervals
  EXPECT_EQ(FrameLoop(headset, *navigation, builder, options).run().displayed, 4);
}

TEST(FrameLoop, DrawsEveryNthFrameHoweverSlowTheSink) {
  fake::FakeHeadset headset(pairs(20));
  const auto navigation = session();
  SceneBuilder builder;
  LoopOptions options;
  options.draw_every = 3;
  CountingSink sink;
  // Every buffer is full by then, and the loop waits.
  test::ShownFrames shown;
  sink.shown = &shown;
  sink.wait_for_shown = 13;
  FrameLoop loop(headset, *navigation, builder, options);
  loop.observe(&shown);
  loop.draw_into(&sink);
  const auto report = loop.run();
  ASSERT_TRUE(report.ended.ok());
  EXPECT_THAT(sink.frames, ::testing::ElementsAre(0, 3, 6, 9, 12, 15, 18));
  EXPECT_EQ(report.drawn, 8) << "and the one that takes all back";
}

TEST(FrameLoop, DrawsRarelyWhileNoScrewIsGuided) {
  fake::FakeHeadset headset(pairs(20));
  const auto navigation = session();
  SceneBuilder builder;
  LoopOptions options;
  options.draw_every = 3;
  options.unguided_every = 2;
  CountingSink sink;
  FrameLoop loop(headset, *navigation, builder, options);
  loop.draw_into(&sink);
  ASSERT_TRUE(loop.run().ended.ok());
  EXPECT_THAT(sink.frames, ::testing::ElementsAre(0, 6, 12, 18));
}

TEST(FrameLoop, ASinkThatFailsForGoodEndsTheRun) {
  fake::FakeHeadset headset(pairs(20));
  const auto navigation = session();
  SceneBuilder builder;
  CountingSink sink;
  sink.fail_at = 2;
  LoopOptions options;
  options.max_errors_in_a_row = 5;
  FrameLoop loop(headset, *navigation, builder, options);
  loop.draw_into(&sink);
  const auto report = loop.run();
  ASSERT_FALSE(report.ended.ok());
  EXPECT_THAT(report.ended.error().message,
              ::testing::HasSubstr("6 failures in a row (limit 5): "));
  EXPECT_THAT(report.ended.error().message, ::testing::HasSubstr("display unplugged"));
}

TEST(FrameLoop, ASceneThatIsRefusedDoesNotBlackOutTheOthers) {
  fake::FakeHeadset headset(pairs(20));
  const auto navigation = session();
  SceneBuilder builder;
  CountingSink sink;
  sink.fail_at = 17;
  FrameLoop loop(headset, *navigation, builder, {});
  loop.draw_into(&sink);
  const auto report = loop.run();
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(sink.frames.size(), 20u);
  EXPECT_EQ(report.draw_failures, 3);
  EXPECT_EQ(report.last_failure, "display unplugged");
}

/// A headset whose clicker is not there while the pairs of [3, 53) come.
class AwayClicker : public ForwardingHeadset, private Clicker {
 public:
  explicit AwayClicker(Headset& inner) : ForwardingHeadset(inner) {}
  [[nodiscard]] Clicker& clicker() override { return *this; }

 private:
  int polls_ = 0;
  Status do_poll(Timestamp, std::vector<ClickerEvent>&) override {
    const int poll = polls_++;
    return poll >= 3 && poll < 53 ? Status(Error{"no pedal", ErrorCode::kUnavailable}) : Status();
  }
};

TEST(FrameLoop, SaysWhileThereIsNoClickerAndGoesOn) {
  struct Watching : LoopObserver {
    void stepped(const FrameHeader&, const Inputs&, const Guidance& guidance) override {
      std::string text;
      append_status(text, guidance.status);
      shown += text.find("no clicker") != std::string::npos ? 1 : 0;
    }
    void input_failed(const std::string& why) override { told.push_back(why); }
    int shown = 0;
    std::vector<std::string> told;
  } watching;
  fake::FakeHeadset inner(pairs(60));
  AwayClicker headset(inner);
  const auto navigation = session();
  SceneBuilder builder;
  FrameLoop loop(headset, *navigation, builder, {});
  loop.observe(&watching);
  const auto report = loop.run();
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.displayed, 60);
  EXPECT_EQ(watching.shown, 50);
  EXPECT_THAT(watching.told, ::testing::ElementsAre("no pedal"));
  EXPECT_EQ(report.failures, 1);
  EXPECT_EQ(report.last_failure, "no pedal");
}

TEST(FrameLoop, GoesOnAfterFailuresOfEveryDevice) {
  fake::Script script = pairs(20);
  script.voice.push_back({"start", 1.0, kStart + 5 * kPair});
  script.clicker.push_back({ClickerAction::kPress, kStart + 6 * kPair});
  fake::FakeHeadset inner(std::move(script));
  fake::Faults faults;
  faults.clicker = {{0, fake::EventFault::kError}};
  faults.camera = {{3, fake::CameraFault::kError}, {7, fake::CameraFault::kWrongSize}};
  faults.voice = {{0, fake::EventFault::kError}};
  fake::FailingHeadset headset(inner, faults);
  const auto navigation = session();
  SceneBuilder builder;
  const auto report = FrameLoop(headset, *navigation, builder, {}).run();
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.failures, 4);
  EXPECT_EQ(report.displayed, 20 - 2) << "two pairs are gone, no more";
  EXPECT_FALSE(report.last_failure.empty());
  EXPECT_EQ(navigation->current_step(), Step::kDigitize) << "the phrase came with the next poll";
}

TEST(FrameLoop, GivesUpOnADeviceThatFailsForGoodAndKeepsWhatItMeasured) {
  fake::Script script = pairs(10);
  for (int i = 0; i < 100; ++i) {
    script.camera.push_back(Error{"cable"});
  }
  fake::FakeHeadset headset(std::move(script));
  const auto navigation = session();
  SceneBuilder builder;
  LoopOptions options;
  options.max_errors_in_a_row = 5;
  const auto report = FrameLoop(headset, *navigation, builder, options).run();
  ASSERT_FALSE(report.ended.ok());
  EXPECT_THAT(report.ended.error().message,
              ::testing::HasSubstr("6 failures in a row (limit 5): "));
  EXPECT_THAT(report.ended.error().message, ::testing::HasSubstr("cable"));
  EXPECT_EQ(report.displayed, 10);
  EXPECT_EQ(report.last_frame, kStart + 10 * kPair);
  EXPECT_EQ(report.intervals_ms.count(), 9);
  EXPECT_EQ(report.step_wall_ms.count(), 10);
  EXPECT_EQ(report.failures, 6);
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
  EXPECT_THAT(left, ::testing::ElementsAre(9));
  EXPECT_EQ(queue.dropped(), 9);
  EXPECT_EQ(queue.acquire(), nullptr) << "closed";
}

}  // namespace
}  // namespace orthonav::engine
