#include <gmock/gmock.h>

#include <algorithm>

#include "engine/case/tool_file.h"
#include "engine/session/text/wording.h"
#include "hal/fake/failing.h"
#include "study/simulated_operation.h"
#include "tests/engine/live/guiding_loop.h"
#include "tests/support/scripted_pairs.h"

namespace orthonav::engine {
namespace {

using test::kPair;
using test::kStart;
using test::pairs;

/// The angle readout is there, without a number.
bool shows_dashes(const ShownFrame& frame) {
  return std::any_of(frame.holograms.begin(), frame.holograms.end(), [](const ShownHologram& h) {
    return h.kind == HologramKind::kAngle && !h.reading;
  });
}

Notice notice_of(const ShownFrame& frame) {
  return frame.status ? frame.status->notice : Notice::kNone;
}

/// Its clock goes on while there is no pair.
class WaitingCamera : public ForwardingCamera {
 public:
  explicit WaitingCamera(fake::FakeHeadset& inner)
      : ForwardingCamera(*inner.cameras()), inner_(inner) {}

 private:
  fake::FakeHeadset& inner_;
  Result<Next> do_next(StereoFrame& frame) override {
    auto next = ForwardingCamera::do_next(frame);
    if (next && *next == Next::kNone) {
      inner_.manual_clock().advance(std::chrono::milliseconds(20));
    }
    return next;
  }
};

class WaitingHeadset : public ForwardingHeadset {
 public:
  explicit WaitingHeadset(fake::FakeHeadset& inner) : ForwardingHeadset(inner), cameras_(inner) {}
  [[nodiscard]] std::string name() const override { return "waiting"; }
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }

 private:
  WaitingCamera cameras_;
};

TEST_F(GuidingLoop, TakesGuidanceBackWhilePairsFail) {
  fake::FakeHeadset inner(pairs(12));
  fake::Faults faults;
  for (int i = 5; i < 9; ++i) {
    faults.camera.push_back({i, fake::CameraFault::kError});
  }
  fake::FailingHeadset headset(inner, faults);
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.blanked, 1);
  const auto frames = seen.frames();
  // Five pairs, one frame that takes back, three pairs, the end.
  ASSERT_EQ(frames.size(), 10u);
  EXPECT_TRUE(shows_triangle(frames[4]));
  EXPECT_FALSE(shows_triangle(frames[5]));
  EXPECT_TRUE(shows_dashes(frames[5]));
  EXPECT_EQ(notice_of(frames[5]), Notice::kNoImages);
  EXPECT_LE(frames[5].display_time - frames[4].pose_time,
            s.session().options().stale_after + kPair);
  EXPECT_TRUE(shows_triangle(frames[6])) << "and goes on with the next pair";
}

/// 50 pairs of a headset with sensors, of which those from 5 to 44 repeat something.
fake::Script with_repeats(Repeated what) {
  fake::Script script = pairs(50);
  script.may_repeat = {};
  for (int i = 0; i < 50; ++i) {
    const auto number = [&](bool repeats) {
      return static_cast<std::uint8_t>(repeats && i >= 5 && i < 45 ? 4 : i);
    };
    const bool both = what == Repeated::kBothPictures;
    auto& frame = std::get<StereoFrame>(script.camera[static_cast<std::size_t>(i)]);
    frame.left = GreyImage(640, 480, number(both || what == Repeated::kLeftPicture));
    frame.right = GreyImage(640, 480, number(both || what == Repeated::kRightPicture));
    frame.world_from_rig = Transform<World, Rig>(
        Mat3::identity(), {1e-5 * number(what == Repeated::kHeadPose), 0.0, 0.0});
  }
  return script;
}

/// Keeps what the wearer is told while nothing guides.
class Withdrawals : public LoopObserver {
 public:
  std::vector<std::string> told;
  void withdrawn(const Guidance& guidance) override {
    told.push_back(detail_text(guidance.status));
  }
};

TEST_F(GuidingLoop, TakesGuidanceBackAndSaysWhyWhileAPictureOrThePoseRepeats) {
  const std::pair<Repeated, const char*> cases[] = {
      {Repeated::kLeftPicture, "left camera repeats its picture: nothing is guided"},
      {Repeated::kRightPicture, "right camera repeats its picture: nothing is guided"},
      {Repeated::kBothPictures, "both cameras repeat their pictures: nothing is guided"},
      {Repeated::kHeadPose, "head tracking repeats its pose: nothing is guided"}};
  for (const auto& [what, words] : cases) {
    fake::FakeHeadset headset(with_repeats(what));
    Withdrawals observer;
    const auto report = run(headset, &observer);
    ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
    EXPECT_EQ(report.blanked, 1);
    EXPECT_EQ(report.repeated, 41) << "and the first one after it, which is not trusted yet";
    EXPECT_EQ(report.failures, 0);
    EXPECT_THAT(observer.told, ::testing::ElementsAre(words, "ended"));
    const auto frames = seen.frames();
    // Five pairs, one frame that takes back, four pairs, the end.
    ASSERT_EQ(frames.size(), 11u);
    EXPECT_TRUE(shows_triangle(frames[4]));
    EXPECT_FALSE(shows_triangle(frames[5]));
    EXPECT_EQ(notice_of(frames[5]), Notice::kNoImages);
    EXPECT_THAT(frames[5].status->text, ::testing::HasSubstr(words));
    EXPECT_LE(frames[5].display_time - frames[4].pose_time,
              s.session().options().stale_after + kPair);
    EXPECT_TRUE(shows_triangle(frames[6])) << "and goes on";
    s.pair();
  }
}

/// Each picture twice, as from a stream at twice its camera's rate: guided on the first of both.
TEST_F(GuidingLoop, LeavesOutASecondOfTheSamePictureAlone) {
  fake::Script script = pairs(20);
  script.may_repeat = {};
  for (int i = 0; i < 20; ++i) {
    auto& frame = std::get<StereoFrame>(script.camera[static_cast<std::size_t>(i)]);
    frame.left = frame.right = GreyImage(640, 480, static_cast<std::uint8_t>(i / 2));
    frame.world_from_rig = Transform<World, Rig>(Mat3::identity(), {1e-5 * i, 0.0, 0.0});
  }
  fake::FakeHeadset headset(std::move(script));
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.repeated, 10);
  EXPECT_EQ(report.displayed, 10);
  EXPECT_EQ(report.blanked, 0);
}

TEST_F(GuidingLoop, EndsAfterTheTimeAskedForThoughAPictureRepeats) {
  fake::FakeHeadset headset(with_repeats(Repeated::kLeftPicture));
  options.max_time = 10 * kPair;
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.displayed, 5);
  EXPECT_EQ(report.repeated, 6) << "until the tenth interval is over";
}

TEST_F(GuidingLoop, TakesGuidanceBackWhileNoPairComes) {
  fake::Script script = pairs(2);
  for (int i = 0; i < 10; ++i) {
    script.camera.emplace_back(Next::kNone);
  }
  script.camera.emplace_back(test::dark_pair(10));
  fake::FakeHeadset inner(std::move(script));
  WaitingHeadset headset(inner);
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.blanked, 1);
  const auto frames = seen.frames();
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_FALSE(shows_triangle(frames[2]));
  EXPECT_LE(frames[2].display_time - frames[1].pose_time,
            s.session().options().stale_after + std::chrono::milliseconds(20));
}

TEST_F(GuidingLoop, EndsWhenNoPairEverComesAgain) {
  fake::Script script = pairs(2);
  for (int i = 0; i < 100; ++i) {
    script.camera.emplace_back(Next::kNone);
  }
  fake::FakeHeadset inner(std::move(script));
  WaitingHeadset headset(inner);
  options.longest_silence = std::chrono::milliseconds(500);
  const auto report = run(headset);
  ASSERT_FALSE(report.ended.ok());
  EXPECT_THAT(report.ended.error().message, ::testing::HasSubstr("no camera pair for"));
}

/// A camera that delivers pairs until its server is gone; what the run asks for is said in
/// `options`.
fake::Script gone_after(int delivered) {
  fake::Script script = pairs(delivered);
  for (int i = 0; i < 1000; ++i) {
    script.camera.emplace_back(Next::kNone);
  }
  return script;
}

TEST_F(GuidingLoop, EndsAfterTheTimeAskedForThoughNoPairComes) {
  fake::FakeHeadset inner(gone_after(4));
  WaitingHeadset headset(inner);
  options.max_time = std::chrono::seconds(12);
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.displayed, 4);
  const Duration ran = inner.manual_clock().now() - (kStart + kPair);
  EXPECT_GE(ran, options.max_time);
  EXPECT_LE(ran, options.max_time + std::chrono::milliseconds(40));
}

TEST_F(GuidingLoop, ATimeInWhichNoPairCameAtAllIsNoRun) {
  fake::FakeHeadset inner(gone_after(0));
  WaitingHeadset headset(inner);
  options.max_time = std::chrono::seconds(12);
  const auto report = run(headset);
  ASSERT_FALSE(report.ended.ok());
  EXPECT_THAT(report.ended.error().message, ::testing::HasSubstr("no camera pair for 12."));
}

TEST_F(GuidingLoop, AnAnswerWithoutAPairDoesNotExcuseTheErrorsAroundIt) {
  fake::Script script = pairs(1);
  for (int i = 0; i < 10; ++i) {
    script.camera.emplace_back(Error{"cable"});
    script.camera.emplace_back(Next::kNone);
  }
  fake::FakeHeadset headset(std::move(script));
  options.max_errors_in_a_row = 5;
  EXPECT_FALSE(run(headset).ended.ok());
}

TEST_F(GuidingLoop, LeavesOnlyTheStatusLineHoweverItEnds) {
  fake::Script script = pairs(3);
  for (int i = 0; i < 10; ++i) {
    script.camera.emplace_back(Error{"cable"});
  }
  options.max_errors_in_a_row = 5;
  fake::FakeHeadset failing(std::move(script));
  fake::FakeHeadset ending(pairs(3));
  for (fake::FakeHeadset* headset : {&failing, &ending}) {
    EXPECT_EQ(run(*headset).ended.ok(), headset == &ending);
    const auto frames = seen.frames();
    ASSERT_EQ(frames.size(), 4u);
    EXPECT_TRUE(shows_triangle(frames[2]));
    EXPECT_TRUE(frames[3].holograms.empty());
    EXPECT_EQ(notice_of(frames[3]), Notice::kEnded);
  }
}

/// Tracking that takes its time, by the device's clock.
class SlowTracking : public LoopObserver {
 public:
  SlowTracking(fake::ManualClock& clock, Duration takes) : clock_(clock), takes_(takes) {}
  void stepped(const FrameHeader&, const Inputs&, const Guidance&) override {
    clock_.advance(takes_);
  }

 private:
  fake::ManualClock& clock_;
  Duration takes_;
};

TEST_F(GuidingLoop, HidesWhatGrewTooOldWhileItWasTracked) {
  // 16 ms of display on top: 83 ms is still within the limit of 100, 85 ms is not.
  for (const auto& [takes_ms, shown] : {std::pair{83, true}, std::pair{85, false}}) {
    fake::FakeHeadset headset(pairs(1));
    SlowTracking slow(headset.manual_clock(), std::chrono::milliseconds(takes_ms));
    ASSERT_TRUE(run(headset, &slow).ended.ok());
    const auto frames = seen.frames();
    ASSERT_FALSE(frames.empty());
    EXPECT_EQ(shows_triangle(frames[0]), shown) << takes_ms;
  }
}

/// Keeps the pairs of the tool guidance that it was given to draw.
class PairsOfGuidance : public SnapshotSink {
 public:
  Status draw(const Snapshot& snapshot) override {
    tool_times.push_back(snapshot.tool_time);
    return {};
  }
  std::vector<std::optional<Timestamp>> tool_times;
};

TEST_F(GuidingLoop, TellsTheDrawerOfWhichPairGuidanceIs) {
  fake::FakeHeadset headset(pairs(2));
  PairsOfGuidance drawn;
  ASSERT_TRUE(run(headset, nullptr, &drawn).ended.ok());
  ASSERT_EQ(drawn.tool_times.size(), 3u);
  EXPECT_EQ(drawn.tool_times[0], test::kStart + kPair);
  EXPECT_EQ(drawn.tool_times[1], test::kStart + 2 * kPair);
  EXPECT_EQ(drawn.tool_times[2], std::nullopt) << "taken back at the end";
}

TEST(LoopOptions, NamesEveryProblem) {
  LoopOptions bad;
  bad.draw_every = -1;
  bad.unguided_every = 0;
  bad.max_frames = -1;
  bad.max_errors_in_a_row = -1;
  bad.longest_silence = Duration::zero();
  EXPECT_EQ(bad.check().size(), 5u);
  EXPECT_TRUE(LoopOptions{}.check().empty());
}

TEST(OperationOptions, NamesTheProblemsOfAllItsParts) {
  OperationOptions bad;
  bad.tools = built_in_tools();
  EXPECT_TRUE(bad.check().empty());
  bad.method = "guess";
  bad.session.stale_after = Duration::zero();
  bad.loop.draw_every = -1;
  bad.visibility.grades = {0.2, 0.1};
  EXPECT_EQ(bad.check().size(), 4u);
}

}  // namespace
}  // namespace orthonav::engine
