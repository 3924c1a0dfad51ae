// How the public calls handle devices that break their promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/fake/failing.h"
#include "tests/support/scripted_session.h"
#include "tests/support/session_log.h"

namespace orthonav::fake {
namespace {

using orthonav::test::play;
using orthonav::test::scripted_pose;
using orthonav::test::scripted_session;
using orthonav::test::scripted_time;
using orthonav::test::SessionLog;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SessionLog play_with(Faults faults) {
  FakeHeadset inner(scripted_session());
  FailingHeadset failing(inner, std::move(faults));
  return play(failing);
}

std::vector<std::int64_t> sequences(const SessionLog& log) {
  std::vector<std::int64_t> numbers;
  for (const auto& moment : log.moments) {
    numbers.push_back(moment.frame.sequence);
  }
  return numbers;
}

struct CameraCase {
  std::string name;
  CameraFault fault;
  std::string says;
};

class BrokenPair : public ::testing::TestWithParam<CameraCase> {};

TEST_P(BrokenPair, IsReportedAndNotPassedOn) {
  const SessionLog log = play_with({.camera = {{2, GetParam().fault}}});
  ASSERT_EQ(log.errors.size(), 1u);
  EXPECT_THAT(log.errors[0], HasSubstr(GetParam().says));
  EXPECT_THAT(sequences(log), ElementsAre(0, 1, 3, 4, 6, 7, 8, 9, 10, 11));
  EXPECT_TRUE(log.ended);
}

TEST_P(BrokenPair, LeavesAnEmptyFrame) {
  FakeHeadset inner(scripted_session());
  FailingHeadset failing(inner, {.camera = {{2, GetParam().fault}}});
  StereoFrame frame;
  ASSERT_TRUE(failing.cameras()->next(frame).ok());
  ASSERT_TRUE(failing.cameras()->next(frame).ok());
  EXPECT_EQ(frame.left.width_px, 640);
  ASSERT_FALSE(failing.cameras()->next(frame).ok());
  EXPECT_EQ(frame.left.width_px, 0);
  EXPECT_TRUE(frame.left.pixels.empty());
  EXPECT_TRUE(frame.right.pixels.empty());
  EXPECT_FALSE(frame.world_from_rig.has_value());
}

INSTANTIATE_TEST_SUITE_P(
    Every, BrokenPair,
    ::testing::Values(
        CameraCase{"Error", CameraFault::kError, "simulated failure"},
        CameraCase{"WrongSize", CameraFault::kWrongSize, "left image is 640x479 px"},
        CameraCase{"ShortBuffer", CameraFault::kShortBuffer, "307199 bytes"},
        CameraCase{"TimeBack", CameraFault::kTimeBack, "does not come after"},
        CameraCase{"SequenceBack", CameraFault::kSequenceBack,
                   "sequence number 1 does not come after 1"},
        CameraCase{"LeftAgain", CameraFault::kLeftAgain, "the left camera repeats its picture"},
        CameraCase{"RightAgain", CameraFault::kRightAgain, "the right camera repeats its picture"},
        CameraCase{"PoseAgain", CameraFault::kPoseAgain, "head tracking repeats its pose"},
        CameraCase{"MirroredPose", CameraFault::kMirroredPose, "not a rigid motion"},
        CameraCase{"NanPose", CameraFault::kNanPose, "not a rigid motion"}),
    [](const auto& broken) { return broken.param.name; });

struct ToolPoseCase {
  std::string name;
  ToolPoseFault fault;
  std::string says;
};

class BrokenToolPoses : public ::testing::TestWithParam<ToolPoseCase> {};

TEST_P(BrokenToolPoses, AreReportedByNameAndNotPassedOn) {
  Script script;
  script.tools = {"pointer", "guide"};
  for (int i = 0; i < 5; ++i) {
    ToolPoses poses;
    poses.sequence = i;
    poses.time = scripted_time(i);
    poses.tools.assign(2, {{}, poses.time, PoseStatus::kMeasured, {}});
    script.tool_poses.emplace_back(poses);
  }
  FakeHeadset inner(script);
  FailingHeadset failing(inner, {.tool_poses = {{2, GetParam().fault}}});
  ToolPoses poses;
  std::vector<std::int64_t> passed_on;
  std::vector<std::string> errors;
  for (;;) {
    const auto next = failing.tool_poses()->next(poses);
    if (!next) {
      errors.push_back(next.error().message);
      EXPECT_TRUE(poses.tools.empty()) << "nothing of them is passed on";
      continue;
    }
    if (*next == Next::kEnd) {
      break;
    }
    passed_on.push_back(poses.sequence);
  }
  EXPECT_THAT(errors, ElementsAre(HasSubstr(GetParam().says)));
  EXPECT_THAT(passed_on, ElementsAre(0, 1, 3, 4));
}

INSTANTIATE_TEST_SUITE_P(
    Every, BrokenToolPoses,
    ::testing::Values(
        ToolPoseCase{"Error", ToolPoseFault::kError, "simulated failure"},
        ToolPoseCase{"OneLess", ToolPoseFault::kOneLess, "of 1 tools, names 2"},
        ToolPoseCase{"Predicted", ToolPoseFault::kPredicted, "pose of guide"},
        ToolPoseCase{"OtherTime", ToolPoseFault::kOtherTime, "is of another time"},
        ToolPoseCase{"TimeBack", ToolPoseFault::kTimeBack, "does not come after"},
        ToolPoseCase{"MirroredPose", ToolPoseFault::kMirroredPose, "not a rigid motion"},
        ToolPoseCase{"NanPose", ToolPoseFault::kNanPose, "not a rigid motion"},
        ToolPoseCase{"NegativeVariance", ToolPoseFault::kNegativeVariance, "negative variance"}),
    [](const auto& broken) { return broken.param.name; });

TEST(MapEpoch, ThatFallsIsReportedAndNotPassedOn) {
  Script script = scripted_session();
  std::int64_t number = 0;
  for (CameraStep& step : script.camera) {
    if (auto* frame = std::get_if<StereoFrame>(&step)) {
      frame->map_epoch = number++ == 2 ? 3 : 4;
    }
  }
  FakeHeadset headset(script);
  StereoFrame frame;
  int refused = 0;
  for (int call = 0; call < 4; ++call) {
    const auto next = headset.cameras()->next(frame);
    if (next) {
      continue;
    }
    ++refused;
    EXPECT_THAT(next.error().message, HasSubstr("map epoch 3 comes after 4"));
  }
  EXPECT_EQ(refused, 1);
}

TEST(AllowedFault, OfTheCamerasIsPassedOn) {
  // Calls: 0, 1, 2 give pairs 0, 1, 2; call 3 has no news.
  const SessionLog dropped = play_with({.camera = {{1, CameraFault::kDrop}}});
  EXPECT_THAT(dropped.errors, IsEmpty());
  EXPECT_THAT(sequences(dropped), ElementsAre(0, 2, 3, 4, 6, 7, 8, 9, 10, 11));
  const SessionLog delayed = play_with({.camera = {{1, CameraFault::kDelay}}});
  EXPECT_THAT(sequences(delayed), ElementsAre(0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11));
  const SessionLog unlocated = play_with({.camera = {{1, CameraFault::kNoPose}}});
  EXPECT_EQ(unlocated.moments.size(), 11u);
  EXPECT_FALSE(unlocated.moments[1].frame.world_from_rig.has_value());
  const SessionLog noisy = play_with({.camera = {{1, CameraFault::kNoise}}});
  const auto plain = orthonav::test::scripted_frame(1);
  EXPECT_EQ(noisy.moments[1].frame.left.at(5, 5), 255 - plain.left.at(5, 5));
}

class BrokenHead : public ::testing::TestWithParam<HeadFault> {};

TEST_P(BrokenHead, IsAnsweredAsLost) {
  FakeHeadset inner(scripted_session());
  inner.manual_clock().set(scripted_time(2));
  FailingHeadset failing(inner, {.head = {{1, GetParam()}}});
  const Timestamp at = scripted_time(1);
  const auto good = failing.head().world_from_rig(at);
  EXPECT_EQ(good.status, PoseStatus::kMeasured);
  EXPECT_EQ(good.value, scripted_pose(1));
  const auto broken = failing.head().world_from_rig(at);
  EXPECT_EQ(broken.status, PoseStatus::kLost);
  EXPECT_EQ(broken.time, at);
  EXPECT_EQ(failing.head().world_from_rig(at).status, PoseStatus::kMeasured);
}

INSTANTIATE_TEST_SUITE_P(Every, BrokenHead,
                         ::testing::Values(HeadFault::kLost, HeadFault::kWrongTime,
                                           HeadFault::kNanPose, HeadFault::kMirroredPose,
                                           HeadFault::kNanCovariance));

class EventsUnderFault : public ::testing::TestWithParam<EventFault> {
 protected:
  /// One poll for everything: either all events come or none.
  static Status poll(std::vector<ClickerEvent>& events, EventFault fault, std::int64_t at) {
    ScriptedClicker inner(scripted_session().clicker);
    FailingClicker clicker(inner, {{at, fault}});
    return clicker.poll(scripted_time(100), events);
  }
  static Status poll(std::vector<Phrase>& phrases, EventFault fault, std::int64_t at) {
    ScriptedVoice inner(scripted_session().voice);
    FailingVoice voice(inner, {{at, fault}});
    return voice.poll(scripted_time(100), phrases);
  }
};

TEST_P(EventsUnderFault, AreReportedAndNotPassedOn) {
  std::vector<ClickerEvent> events = {{ClickerAction::kPress, Timestamp{}}};
  EXPECT_FALSE(poll(events, GetParam(), 3).ok());
  EXPECT_EQ(events.size(), 1u) << "what was there stays, nothing is added";
  if (GetParam() == EventFault::kRepeat || GetParam() == EventFault::kDrop) {
    return;
  }
  std::vector<Phrase> phrases = {{"before", 1.0, Timestamp{}}};
  EXPECT_FALSE(poll(phrases, GetParam(), 1).ok());
  EXPECT_EQ(phrases.size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Every, EventsUnderFault,
                         ::testing::Values(EventFault::kError, EventFault::kTimeBack,
                                           EventFault::kFuture, EventFault::kGarbage,
                                           EventFault::kRepeat, EventFault::kDrop));

TEST(EventsUnderFault, ComeLaterWhenTheyAreDelayed) {
  ScriptedClicker inner(scripted_session().clicker);
  FailingClicker clicker(inner, {{4, EventFault::kDelay}});
  std::vector<ClickerEvent> events;
  ASSERT_TRUE(clicker.poll(scripted_time(100), events).ok());
  EXPECT_EQ(events.size(), 4u);
  ASSERT_TRUE(clicker.poll(scripted_time(101), events).ok());
  EXPECT_TRUE(events == scripted_session().clicker);
}

TEST(EventsUnderFault, ComeAgainAfterAnError) {
  ScriptedVoice inner(scripted_session().voice);
  FailingVoice voice(inner, {{1, EventFault::kError}});
  std::vector<Phrase> phrases;
  EXPECT_FALSE(voice.poll(scripted_time(100), phrases).ok());
  ASSERT_TRUE(voice.poll(scripted_time(101), phrases).ok());
  EXPECT_TRUE(phrases == scripted_session().voice);
}

TEST(EventsUnderFault, StrikeOnceEachWhereTheyFollowOneAnother) {
  for (const EventFault second : {EventFault::kError, EventFault::kDelay}) {
    ScriptedVoice inner(scripted_session().voice);
    FailingVoice voice(inner, {{0, EventFault::kError}, {1, second}});
    std::vector<Phrase> phrases;
    EXPECT_FALSE(voice.poll(scripted_time(100), phrases).ok());
    EXPECT_EQ(voice.poll(scripted_time(101), phrases).ok(), second == EventFault::kDelay);
    ASSERT_TRUE(voice.poll(scripted_time(102), phrases).ok());
    EXPECT_TRUE(phrases == scripted_session().voice);
  }
}

TEST(Clicker, FindsItsPlaceAgainAfterALostRelease) {
  using enum ClickerAction;
  const auto at = [](int ms) { return Timestamp(std::chrono::milliseconds(ms)); };
  ScriptedClicker inner(
      {{kPress, at(1)}, {kRelease, at(2)}, {kPress, at(3)}, {kRelease, at(4)}, {kPress, at(5)}});
  FailingClicker clicker(inner, {{1, EventFault::kDrop}});
  std::vector<ClickerEvent> events;
  EXPECT_TRUE(clicker.poll(at(2), events).ok());
  EXPECT_FALSE(clicker.poll(at(3), events).ok());
  EXPECT_TRUE(clicker.poll(at(5), events).ok());
  EXPECT_THAT(events, ElementsAre(ClickerEvent{kPress, at(1)}, ClickerEvent{kRelease, at(4)},
                                  ClickerEvent{kPress, at(5)}));
}

TEST(ButtonState, DecidesEveryActionInEveryState) {
  using enum ClickerAction;
  constexpr std::array kActions = {kPress, kRelease, kClick, kDoubleClick, kHold};
  const auto allowed = [&](const std::vector<ClickerAction>& before) {
    std::vector<ClickerAction> can_follow;
    for (const ClickerAction action : kActions) {
      ButtonState state;
      for (const ClickerAction earlier : before) {
        EXPECT_TRUE(state.take(earlier).ok());
      }
      if (state.take(action)) {
        can_follow.push_back(action);
      }
    }
    return can_follow;
  };
  EXPECT_THAT(allowed({}), ElementsAre(kPress));
  EXPECT_THAT(allowed({kPress}), ElementsAre(kRelease, kHold));
  EXPECT_THAT(allowed({kPress, kHold}), ElementsAre(kRelease, kHold));
  EXPECT_THAT(allowed({kPress, kRelease}), ElementsAre(kPress, kClick));
  EXPECT_THAT(allowed({kPress, kRelease, kClick}), ElementsAre(kPress));
  EXPECT_THAT(allowed({kPress, kRelease, kPress, kRelease}), ElementsAre(kPress, kClick));
  const std::vector<ClickerAction> twice = {kPress, kRelease, kClick, kPress, kRelease};
  EXPECT_THAT(allowed(twice), ElementsAre(kPress, kClick, kDoubleClick));
  auto doubled = twice;
  doubled.push_back(kDoubleClick);
  EXPECT_THAT(allowed(doubled), ElementsAre(kPress));
  doubled.insert(doubled.end(), {kPress, kRelease});
  EXPECT_THAT(allowed(doubled), ElementsAre(kPress, kClick)) << "a third one starts anew";
}

TEST(Voice, RefusesAConfidenceOutsideZeroToOne) {
  for (const double confidence : {-0.01, 1.01, std::numeric_limits<double>::quiet_NaN()}) {
    ScriptedVoice voice({{"next", confidence, Timestamp{}}});
    std::vector<Phrase> phrases;
    const Status status = voice.poll(Timestamp{}, phrases);
    ASSERT_FALSE(status.ok()) << confidence;
    EXPECT_THAT(status.error().message, HasSubstr("must lie in [0, 1]"));
    EXPECT_TRUE(phrases.empty());
  }
}

}  // namespace
}  // namespace orthonav::fake
