#include "hal/igtl/pose_frames.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "hal/igtl/sender_clock.h"

namespace orthonav::igtl::pose_frames_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

Timestamp at(Duration since) { return Timestamp(since); }

SentPose pose(const std::string& name, double x_m) {
  return {name, Transform<World, Marker>(Mat3::identity(), {x_m, 0.0, 0.0})};
}

bool has(const ToolPoses& frame, std::size_t tool) {
  return frame.tools.at(tool).status == PoseStatus::kMeasured;
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
  EXPECT_TRUE(has(*frame, 0) && has(*frame, 1));
  EXPECT_EQ(frame->tools[1].value.translation().x, 2.0);
  EXPECT_EQ(frame->tools[1].time, frame->time);
  EXPECT_EQ(frame->tools[1].covariance[0], 0.04) << "as it was stated";
  EXPECT_FALSE(frames.next(at(milliseconds(102)))) << "once";
}

TEST(IgtlFrames, PosesFurtherApartAreNot) {
  PoseFrames frames(two_tools());
  frames.take(pose("ProbeToTracker", 1), at(milliseconds(100)), at(milliseconds(101)));
  frames.take(pose("ReferenceToTracker", 2), at(microseconds(102'100)), at(milliseconds(103)));
  const auto first = frames.next(at(milliseconds(103)));
  ASSERT_TRUE(first);
  EXPECT_TRUE(has(*first, 0) && !has(*first, 1));
  const auto second = frames.next(at(milliseconds(113)));
  ASSERT_TRUE(second) << "after waiting for the rest";
  EXPECT_TRUE(!has(*second, 0) && has(*second, 1));
}

TEST(IgtlFrames, ALostToolCompletesItsFrame) {
  PoseFrames frames(two_tools());
  frames.take(pose("ProbeToTracker", 1), at(milliseconds(100)), at(milliseconds(101)));
  frames.take({"ReferenceToTracker", std::nullopt}, at(milliseconds(100)), at(milliseconds(101)));
  const auto frame = frames.next(at(milliseconds(101)));
  ASSERT_TRUE(frame);
  EXPECT_TRUE(has(*frame, 0) && !has(*frame, 1));
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
  EXPECT_FALSE(frames.next(at(milliseconds(210)))) << "nobody took those at 100 and 133 ms";
}

TEST(IgtlFrames, WhereNothingIsSentNoToolIsInSight) {
  PoseFrames frames(two_tools());
  frames.take(pose("ProbeToTracker", 1), at(milliseconds(100)), at(milliseconds(100)));
  ASSERT_TRUE(frames.next(at(milliseconds(110))));
  EXPECT_FALSE(frames.next(at(milliseconds(200))));
  const auto empty = frames.next(at(milliseconds(201)));
  ASSERT_TRUE(empty);
  EXPECT_TRUE(!has(*empty, 0) && !has(*empty, 1));
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
    std::optional<ToolPoses> last;
    for (int i = 0; i <= 40; ++i) {
      const Timestamp time = at(milliseconds(30 * i));
      frames.take(pose("ProbeToTracker", 1.0 + step_m * i), time, time);
      last = frames.next(time);
    }
    return last && has(*last, 0);
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

TEST(IgtlFrames, AToolThatComesInAnotherFrameIsNamedAndNotUsed) {
  const auto complaint_of = [](const std::string& sent, bool also_as_asked) {
    PoseFrames frames(two_tools());
    std::optional<std::string> complaint;
    for (int ms = 0; ms <= 1200; ms += 30) {
      const Timestamp time = at(milliseconds(1000 + ms));
      frames.take(pose("ReferenceToTracker", ms), time, time);
      frames.take(pose(sent, ms), time, time);
      if (also_as_asked) {
        frames.take(pose("ProbeToTracker", ms), time, time);
      }
      if (const auto frame = frames.next(time + milliseconds(10))) {
        EXPECT_TRUE(has(*frame, 1));
        EXPECT_EQ(has(*frame, 0), also_as_asked);
      }
      const auto said = frames.take_complaint();
      EXPECT_FALSE(said && complaint) << "once";
      complaint = said ? said : complaint;
    }
    return complaint.value_or("");
  };
  EXPECT_EQ(complaint_of("ProbeToReference", false),
            "pointer comes as ProbeToReference, in frame \"Reference\", and not as "
            "ProbeToTracker: it is not used; have it sent in the frame of the others");
  EXPECT_EQ(complaint_of("ProbeToReference", true), "") << "the control: sent for others";
  EXPECT_EQ(complaint_of("ProbeTipToProbe", false), "") << "something else";
}

TEST(IgtlFrames, AreStatedByTheNameOfATransform) {
  const auto read = [](const std::string& name) {
    const auto frames = frames_named(name);
    return !frames ? "several" : !*frames ? "none" : (*frames)->of + " in " + (*frames)->in;
  };
  EXPECT_EQ(read("StylusToReference"), "Stylus in Reference");
  EXPECT_EQ(read("ToolToTracker"), "Tool in Tracker");
  EXPECT_EQ(read("stylusTo2"), "stylus in 2");
  EXPECT_EQ(read("PointerToTorso"), "Pointer in Torso");
  EXPECT_EQ(read("stylustoreference"), "stylus in reference");
  EXPECT_EQ(read("tooltotracker"), "tool in tracker");
  EXPECT_EQ(read("STYLUSTOREFERENCE"), "STYLUS in REFERENCE");
  EXPECT_EQ(read("stylus_to_tracker"), "stylus_ in _tracker");
  EXPECT_EQ(read("AToBToC"), "several");
  for (const char* name : {"Tracker0", "Stylus", "Tool", "motor", "To", "ToTracker", "StylusTo"}) {
    EXPECT_EQ(read(name), "none") << name;
  }
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
double seconds_of(Duration d) { return orthonav::seconds(d); }

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

/// A sender whose clock can be set, on a network that takes no time unless told otherwise.
class ClockedSender {
 public:
  explicit ClockedSender(Duration interval) : interval_(interval) {}

  /// Sends for so long, each message delayed by `delay`. Times that count as known must be as old
  /// as they are, to within `off_by`; none need be known before `knows_after`.
  void send_for(Duration time, Duration delay = {}, Duration knows_after = {},
                Duration off_by = milliseconds(1)) {
    for (const Timestamp end = now_ + time; now_ < end; now_ += interval_) {
      const Timestamp arrived = now_ + delay;
      const Timestamp told = take(now_, arrived);
      doubted += clock.known() ? 0 : 1;
      if (clock.known()) {
        EXPECT_LE(std::chrono::abs(told - now_), off_by) << "at " << seconds(now_ - Timestamp());
      }
      EXPECT_TRUE(clock.known() || end - now_ > time - knows_after);
      if (const auto step = clock.take_step()) {
        steps.push_back(*step);
      }
    }
  }
  Timestamp take(Timestamp sent, Timestamp arrived, const std::string& device = "ProbeToTracker") {
    return clock.time_of(stamp(kStart_s + orthonav::seconds(sent - Timestamp() + set_)), arrived,
                         device);
  }
  void set(Duration by) { set_ += by; }
  [[nodiscard]] Timestamp now() const { return now_; }

  SenderClock clock;
  std::vector<Duration> steps;  ///< as it said
  int doubted = 0;

 private:
  static double seconds(Duration d) { return orthonav::seconds(d); }
  Duration interval_;
  Duration set_{};
  Timestamp now_ = at(std::chrono::seconds(1));
};

TEST(IgtlSenderClock, ThatIsSetIsKnownAgainSoonAndSaysByHowMuch) {
  for (const Duration interval : {milliseconds(16), milliseconds(33), milliseconds(100)}) {
    for (const Duration set :
         {milliseconds(-30), milliseconds(-50), milliseconds(-100), milliseconds(-300),
          milliseconds(-1000), milliseconds(-7'200'000), milliseconds(30), milliseconds(50),
          milliseconds(300), milliseconds(1000), milliseconds(7'200'000)}) {
      SCOPED_TRACE(testing::Message() << seconds_of(set) << " s, every " << seconds_of(interval));
      ClockedSender sender(interval);
      sender.send_for(seconds(4));
      EXPECT_EQ(sender.doubted, 0);
      sender.set(set);
      sender.send_for(seconds(2), {}, milliseconds(600));
      EXPECT_GT(sender.doubted, 0);
      ASSERT_EQ(sender.steps.size(), 1u);
      EXPECT_LT(std::chrono::abs(sender.steps[0] - set), milliseconds(1));
      // And once more, as NTP may.
      sender.set(-set);
      sender.send_for(seconds(2), {}, milliseconds(600));
      EXPECT_EQ(sender.steps.size(), 2u);
    }
  }
}

TEST(IgtlSenderClock, TakesASmallerStepForADelay) {
  ClockedSender sender(milliseconds(33));
  sender.send_for(seconds(4));
  sender.set(milliseconds(-19));
  sender.send_for(seconds(2), {}, {}, milliseconds(20));
  sender.set(milliseconds(19));
  sender.send_for(seconds(2), {}, {}, milliseconds(20));
  EXPECT_TRUE(sender.steps.empty());
}

TEST(IgtlSenderClock, TakesNoDelayForAStep) {
  ClockedSender sender(milliseconds(33));
  sender.send_for(seconds(2));
  // It stalls, and what queued meanwhile stays queued.
  sender.send_for(seconds(3), milliseconds(300), {}, milliseconds(1));
  EXPECT_GT(sender.clock.late(), milliseconds(299));
  // It drains.
  sender.send_for(seconds(2));
  // A network on which every other message is late.
  for (int i = 0; i < 60; ++i) {
    sender.send_for(milliseconds(33), milliseconds(i % 2 == 0 ? 0 : 30));
  }
  // One on which anything up to 80 ms happens.
  Random random(5);
  Timestamp arrived = sender.now();
  for (int i = 0; i < 2000; ++i) {
    const Timestamp sent = sender.now() + milliseconds(33) * i;
    arrived = std::max(arrived, sent + from_seconds(random.uniform(0.0, 0.08)));
    (void)sender.take(sent, arrived);
    sender.doubted += sender.clock.known() ? 0 : 1;
    EXPECT_FALSE(sender.clock.take_step());
  }
  EXPECT_TRUE(sender.steps.empty());
  EXPECT_EQ(sender.doubted, 0);
}

TEST(IgtlSenderClock, ThatIsSlowedDownOrAQueueThatStaysWantANewConnection) {
  const auto wanted = [](Duration delay, double slower_by) {
    ClockedSender sender(milliseconds(33));
    std::vector<double> at_s;
    for (Timestamp now = at(seconds(1)); now < at(seconds(3600)); now += milliseconds(33)) {
      const Timestamp sent = now + from_seconds(-slower_by * orthonav::seconds(now - Timestamp()));
      (void)sender.take(sent, now + (now > at(seconds(10)) ? delay : Duration::zero()));
      if (sender.clock.wants_new_connection()) {
        at_s.push_back(orthonav::seconds(now - Timestamp()));
        sender.clock.forget();
      }
    }
    return at_s;
  };
  EXPECT_TRUE(wanted(milliseconds(99), 0.0).empty()) << "not too late";
  ASSERT_EQ(wanted(milliseconds(101), 0.0).size(), 1u) << "its queue is gone then";
  EXPECT_NEAR(wanted(milliseconds(101), 0.0)[0], 15.0, 0.2);
  EXPECT_TRUE(wanted({}, 100e-6).empty()) << "as clocks drift";
  // NTP slows a clock down by up to 500 parts in a million.
  const auto slowed = wanted({}, 500e-6);
  EXPECT_GT(slowed.size(), 10u);
  EXPECT_NEAR(slowed.at(0), 0.1 / 400e-6 + 5.0, 5.0);
}

TEST(IgtlSenderClock, TakesAWrongStampForWhatItIs) {
  for (const Duration wrong : {milliseconds(-5000), milliseconds(-100), milliseconds(5000)}) {
    ClockedSender sender(milliseconds(33));
    sender.send_for(seconds(2));
    sender.set(wrong);
    (void)sender.take(sender.now(), sender.now());
    EXPECT_FALSE(sender.clock.known());
    sender.set(-wrong);
    sender.send_for(seconds(1));
    EXPECT_TRUE(sender.steps.empty());
    EXPECT_EQ(sender.doubted, 0);
  }
}

TEST(IgtlSenderClock, ThatIsSetWhileAQueueLastsLeavesItsMessagesOld) {
  ClockedSender sender(milliseconds(33));
  sender.send_for(seconds(2));
  sender.send_for(seconds(2), milliseconds(200), {}, milliseconds(1));
  sender.set(milliseconds(-300));
  sender.send_for(seconds(2), milliseconds(200), milliseconds(600), milliseconds(1));
  EXPECT_EQ(sender.steps.size(), 1u);
  EXPECT_GT(sender.clock.late(), milliseconds(198));
}

TEST(IgtlSenderClock, MaySendDevicesOfDifferentMoments) {
  ClockedSender sender(milliseconds(33));
  for (int i = 0; i < 100; ++i) {
    const Timestamp now = at(milliseconds(33 * i + 1000));
    (void)sender.take(now, now, "ProbeToTracker");
    const Timestamp slow = sender.take(now - milliseconds(60), now, "CameraToTracker");
    EXPECT_LT(std::chrono::abs(slow - (now - milliseconds(60))), kRounding);
    EXPECT_TRUE(sender.clock.known());
  }
}

TEST(IgtlSenderClock, WithoutStampsAPoseIsOfItsArrival) {
  SenderClock clock;
  EXPECT_EQ(clock.time_of(0, at(milliseconds(30))), at(milliseconds(30)));
  EXPECT_EQ(clock.time_of(0, at(milliseconds(90))), at(milliseconds(90)));
}

}  // namespace
}  // namespace orthonav::igtl::pose_frames_test
