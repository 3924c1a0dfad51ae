#include "hal/igtl/pose_frames.h"

#include <gtest/gtest.h>

#include "hal/igtl/sender_clock.h"

namespace orthonav::igtl::pose_frames_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

Timestamp at(Duration since) { return Timestamp(since); }

SentPose pose(const std::string& name, double x_m) {
  return {name, Transform<Rig, Marker>(Mat3::identity(), {x_m, 0.0, 0.0})};
}

PoseFramesOptions two_tools() {
  PoseFramesOptions options;
  options.tools = {{"pointer", "ProbeToTracker"}, {"reference", "ReferenceToTracker"}};
  options.covariance[0] = 0.04;
  return options;
}

TEST(IgtlFrames, PosesOfOneMomentAreOneFrame) {
  PoseFrames frames(two_tools());
  frames.take(pose("ProbeToTracker", 1), at(milliseconds(100)), at(milliseconds(101)));
  EXPECT_FALSE(frames.next(at(milliseconds(101)))) << "the other may come";
  frames.take(pose("ReferenceToTracker", 2), at(milliseconds(102)), at(milliseconds(102)));
  const auto frame = frames.next(at(milliseconds(102)));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->time, at(milliseconds(100)));
  ASSERT_EQ(frame->tools.size(), 2u);
  EXPECT_EQ(frame->tools[1].tool, 1u);
  EXPECT_EQ(frame->tools[1].rig_from_marker.translation().x, 2.0);
  EXPECT_EQ(frame->tools[1].covariance[0], 0.04) << "as it was stated";
  EXPECT_FALSE(frames.next(at(milliseconds(102)))) << "once";
}

TEST(IgtlFrames, PosesFurtherApartAreNot) {
  PoseFrames frames(two_tools());
  frames.take(pose("ProbeToTracker", 1), at(milliseconds(100)), at(milliseconds(101)));
  frames.take(pose("ReferenceToTracker", 2), at(microseconds(102'100)), at(milliseconds(103)));
  const auto first = frames.next(at(milliseconds(103)));
  ASSERT_TRUE(first);
  ASSERT_EQ(first->tools.size(), 1u);
  EXPECT_EQ(first->tools[0].tool, 0u);
  const auto second = frames.next(at(milliseconds(113)));
  ASSERT_TRUE(second) << "after waiting for the rest";
  ASSERT_EQ(second->tools.size(), 1u);
  EXPECT_EQ(second->tools[0].tool, 1u);
}

TEST(IgtlFrames, ALostToolIsLeftOutAndCompletesItsFrame) {
  PoseFrames frames(two_tools());
  frames.take(pose("ProbeToTracker", 1), at(milliseconds(100)), at(milliseconds(101)));
  frames.take({"ReferenceToTracker", std::nullopt}, at(milliseconds(100)), at(milliseconds(101)));
  const auto frame = frames.next(at(milliseconds(101)));
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->tools.size(), 1u);
  EXPECT_EQ(frame->tools[0].tool, 0u);
}

TEST(IgtlFrames, WhatComesOutOfOrderIsDropped) {
  PoseFrames frames(two_tools());
  for (const int ms : {100, 133, 120, 100, 166}) {
    frames.take(pose("ProbeToTracker", ms), at(milliseconds(ms)), at(milliseconds(200)));
  }
  const auto frame = frames.next(at(milliseconds(210)));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->time, at(milliseconds(166)));
  EXPECT_EQ(frames.out_of_order(), 2);
  EXPECT_EQ(frames.replaced(), 2) << "nobody took those at 100 and 133 ms";
}

TEST(IgtlFrames, WhereNothingIsSentNoToolIsInSight) {
  PoseFrames frames(two_tools());
  frames.take(pose("ProbeToTracker", 1), at(milliseconds(100)), at(milliseconds(100)));
  ASSERT_TRUE(frames.next(at(milliseconds(110))));
  EXPECT_FALSE(frames.next(at(milliseconds(200))));
  const auto empty = frames.next(at(milliseconds(201)));
  ASSERT_TRUE(empty);
  EXPECT_TRUE(empty->tools.empty());
  EXPECT_EQ(empty->time, at(milliseconds(101)));
  EXPECT_FALSE(frames.next(at(milliseconds(202))));
  frames.take(pose("ProbeToTracker", 2), at(milliseconds(150)), at(milliseconds(203)));
  EXPECT_TRUE(frames.next(at(milliseconds(213)))) << "late, and not too late";
}

TEST(IgtlFrames, APoseThatNobodyMeasuresAnyMoreIsLost) {
  const auto last_has_tool = [](Duration frozen_after, double step_m) {
    PoseFramesOptions options = two_tools();
    options.tools.pop_back();
    options.frozen_after = frozen_after;
    PoseFrames frames(options);
    std::optional<PoseFrame> last;
    for (int i = 0; i <= 40; ++i) {
      const Timestamp time = at(milliseconds(30 * i));
      frames.take(pose("ProbeToTracker", 1.0 + step_m * i), time, time);
      last = frames.next(time);
    }
    return last && !last->tools.empty();
  };
  EXPECT_FALSE(last_has_tool(seconds(1), 0.0)) << "1.2 s without a bit of noise";
  EXPECT_TRUE(last_has_tool(seconds(1), 1e-9));
  EXPECT_TRUE(last_has_tool(milliseconds(1200), 0.0)) << "not longer than allowed";
  EXPECT_TRUE(last_has_tool(Duration::zero(), 0.0)) << "not looked for";
}

TEST(IgtlFrames, TransformsThatAreNoToolsAreToldOnceAndNoMoreThanAFew) {
  PoseFrames frames(two_tools());
  for (int i = 0; i < 100; ++i) {
    frames.take(pose("StylusToTracker" + std::to_string(i % 50), 1), at(seconds(1)),
                at(seconds(1)));
  }
  EXPECT_EQ(frames.others().size(), 16u);
  EXPECT_EQ(frames.others().front(), "StylusToTracker0");
  EXPECT_EQ(frames.heard(), 0u);
}

TEST(IgtlFrames, NamesAreComparedAsTheyGoOverTheWire) {
  PoseFramesOptions options;
  options.tools = {{"screwdriver", "ScrewdriverTipToTracker"}};
  PoseFrames frames(options);
  frames.take(pose("ScrewdriverTipToTrac", 1), at(seconds(1)), at(seconds(1)));
  EXPECT_EQ(frames.heard(), 1u);
}

/// Seconds as the protocol stamps them.
std::uint64_t stamp(double s) { return static_cast<std::uint64_t>(s * 4294967296.0); }

constexpr double kStart_s = 1.7e9;  ///< the sender counts from 1970
constexpr Duration kRounding = microseconds(1);

TEST(IgtlSenderClock, TheMessageThatWasFastestTellsTheOffset) {
  SenderClock clock;
  EXPECT_EQ(clock.time_of(stamp(kStart_s), at(milliseconds(30))), at(milliseconds(30)));
  // 20 ms faster: this message and all later ones count from it.
  EXPECT_EQ(clock.time_of(stamp(kStart_s + 0.1), at(milliseconds(110))), at(milliseconds(110)));
  const Timestamp late = clock.time_of(stamp(kStart_s + 0.2), at(milliseconds(350)));
  EXPECT_LT(std::chrono::abs(late - at(milliseconds(210))), milliseconds(1));
  EXPECT_GT(clock.late(), milliseconds(139));
}

TEST(IgtlSenderClock, MessagesThatComeLaterAndLaterAreOldHoweverLongItLasts) {
  SenderClock clock;
  Timestamp time;
  for (int i = 0; i <= 6000; ++i) {
    // For 10 minutes each message is 0.1 ms later than the one before: a growing queue.
    time = clock.time_of(stamp(kStart_s + 0.1 * i), at(microseconds(100'100) * i));
  }
  EXPECT_GT(at(microseconds(100'100) * 6000) - time, milliseconds(500)) << "of 600 ms";
}

TEST(IgtlSenderClock, AClockThatDriftsIsFollowed) {
  SenderClock clock;
  Timestamp time;
  for (int i = 0; i <= 6000; ++i) {
    time = clock.time_of(stamp(kStart_s + 0.1 * i), at(microseconds(100'005) * i));
  }
  EXPECT_LT(at(microseconds(100'005) * 6000) - time, kRounding) << "50 parts in a million";
}

TEST(IgtlSenderClock, WithoutStampsAPoseIsOfItsArrival) {
  SenderClock clock;
  EXPECT_EQ(clock.time_of(0, at(milliseconds(30))), at(milliseconds(30)));
  EXPECT_EQ(clock.time_of(0, at(milliseconds(90))), at(milliseconds(90)));
}

}  // namespace
}  // namespace orthonav::igtl::pose_frames_test
