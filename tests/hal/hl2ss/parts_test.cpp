#include <gmock/gmock.h>

#include <cmath>

#include "hal/hl2ss/arrival_meter.h"
#include "hal/hl2ss/boot_clock.h"
#include "hal/hl2ss/head_track.h"
#include "hal/hl2ss/options.h"
#include "hal/hl2ss/packet_stream.h"
#include "hal/hl2ss/pair_mailbox.h"
#include "hal/hl2ss/server/faults.h"
#include "hal/hl2ss/server/packets.h"

namespace orthonav::hl2ss {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr HostTime kStart{seconds(5000)};
constexpr std::uint64_t kSecond = 10'000'000;

TEST(StampReader, TurnsStampsIntoTimes) {
  StampReader stamps;
  EXPECT_EQ(stamps.time_of(3 * kSecond, kStart), Timestamp(seconds(3)));
  EXPECT_EQ(stamps.time_of(2 * kSecond, kStart), Timestamp(seconds(2))) << "a little late";
  EXPECT_EQ(stamps.base_ticks(), 0);
}

TEST(StampReader, CountsFiletimeFrom1970) {
  StampReader stamps;
  const auto time = stamps.time_of(133'000'000'000'000'000, kStart);
  ASSERT_TRUE(time.has_value());
  EXPECT_EQ(ticks_100ns(*time) + stamps.base_ticks(), 133'000'000'000'000'000);
}

TEST(StampReader, TakesNoStampFromNowhere) {
  StampReader stamps;
  ASSERT_TRUE(stamps.time_of(1000 * kSecond, kStart));
  const HostTime soon = kStart + milliseconds(33);
  EXPECT_FALSE(stamps.time_of(1'000'000 * kSecond, soon)) << "the future";
  EXPECT_FALSE(stamps.time_of(10 * kSecond, soon)) << "long ago";
  EXPECT_FALSE(stamps.time_of(~0ull, soon));
  EXPECT_EQ(stamps.time_of(1001 * kSecond, soon), Timestamp(seconds(1001)));
  EXPECT_EQ(stamps.restarts(), 0);
}

TEST(StampReader, GoesOnWhenTheHeadsetsClockBeginsAnew) {
  StampReader stamps;
  ASSERT_TRUE(stamps.time_of(1000 * kSecond, kStart));
  std::optional<Timestamp> time;
  int doubted = 0;
  HostTime at = kStart + seconds(60);
  for (std::uint64_t i = 0; i < 100 && !time; ++i, ++doubted, at += milliseconds(33)) {
    time = stamps.time_of(5 * kSecond + i * 333'333, at);
  }
  ASSERT_TRUE(time.has_value());
  EXPECT_EQ(doubted, 20);
  EXPECT_EQ(stamps.restarts(), 1);
  EXPECT_GT(*time, Timestamp(seconds(1059))) << "never back";
  EXPECT_LT(*time, Timestamp(seconds(1062)));
}

TEST(BootClock, TakesTheOffsetOfThePacketThatWasUnderwayShortest) {
  BootClock clock;
  const HostTime now = HostClock::now();
  clock.heard(Timestamp(seconds(100)) - milliseconds(30), now);
  clock.heard(Timestamp(seconds(100)) - milliseconds(4), now);
  clock.heard(Timestamp(seconds(100)) - milliseconds(90), now);
  const Duration offset = clock.offset();
  EXPECT_EQ(Timestamp(seconds(100)) - milliseconds(4),
            Timestamp(std::chrono::duration_cast<Duration>(now.time_since_epoch())) + offset);
  EXPECT_EQ(clock.spread(), Duration::zero()) << "of one second";
  EXPECT_GE(clock.now(), Timestamp(seconds(100)) - milliseconds(4));
}

TEST(BootClock, NeverGoesBackAndKnowsWhatItHeard) {
  BootClock clock;
  const HostTime now = HostClock::now();
  clock.heard(Timestamp(seconds(500)), now);
  const Timestamp before = clock.now();
  EXPECT_GE(before, Timestamp(seconds(500)));
  clock.heard(Timestamp(seconds(400)), now);
  EXPECT_GE(clock.now(), before);
}

TEST(BootClock, StandsStillWhilePaced) {
  BootClock clock;
  clock.paced(Timestamp(seconds(7)), HostClock::now());
  EXPECT_EQ(clock.now(), Timestamp(seconds(7)));
  clock.heard(Timestamp(seconds(9)), HostClock::now());
  EXPECT_EQ(clock.now(), Timestamp(seconds(7)));
  clock.paced(Timestamp(seconds(8)), HostClock::now());
  EXPECT_EQ(clock.now(), Timestamp(seconds(8)));
  clock.unpaced();
  EXPECT_GE(clock.now(), Timestamp(seconds(8)));
  EXPECT_LT(clock.now(), Timestamp(seconds(60)));
}

/// An offset from before the clock was set back would make every pair look older by that much.
TEST(BootClock, ForgetsWhatItHeardBeforeTheClockWasSet) {
  BootClock clock;
  const HostTime now = HostClock::now();
  clock.heard(Timestamp(seconds(500)), now);
  clock.restart();
  clock.heard(Timestamp(seconds(400)), now);
  EXPECT_EQ(clock.offset(), Timestamp(seconds(400)).time_since_epoch() -
                                std::chrono::duration_cast<Duration>(now.time_since_epoch()));
  EXPECT_GE(clock.now(), Timestamp(seconds(500))) << "but never goes back";
}

/// A raw picture takes ten milliseconds and more to arrive, by which the clock must not be late.
TEST(BootClock, LearnsFromTheFirstByteOfAPacket) {
  struct Stream final : PacketStream {
    Stream(ArrivalMeter& meter, HeadsetTime& time)
        : PacketStream("test", {1000, false}, meter, time) {}
    std::vector<std::uint8_t> opening() override { return {}; }
    Status take(const Packet& /*packet*/, const Stamped& /*stamped*/) override { return {}; }
  };
  ArrivalMeter meter("test", milliseconds(33));
  HeadsetTime time;
  Stream stream(meter, time);
  const auto arrives = [&](Bytes bytes, HostTime at) {
    std::copy(bytes.begin(), bytes.end(), stream.room().begin());
    ASSERT_TRUE(stream.received(bytes.size(), at).ok());
  };
  std::vector<std::uint8_t> bytes = packet_bytes(100 * kSecond, std::vector<std::uint8_t>(1000));
  const auto second = packet_bytes(100 * kSecond + 10'000, std::vector<std::uint8_t>(1000));
  bytes.insert(bytes.end(), second.begin(), second.end());
  arrives(Bytes(bytes).first(500), kStart);
  // The rest of the first packet brings the beginning of the second.
  arrives(Bytes(bytes).subspan(500, 600), kStart + milliseconds(20));
  const auto begun = std::chrono::duration_cast<Duration>(kStart.time_since_epoch());
  EXPECT_EQ(time.clock.offset(), Duration(seconds(100)) - begun);
  time.clock.restart();
  arrives(Bytes(bytes).subspan(1100), kStart + milliseconds(40));
  EXPECT_EQ(time.clock.offset(),
            Duration(seconds(100)) + milliseconds(1) - begun - milliseconds(20));
}

TEST(ArrivalMeter, MeasuresGapsAndJitter) {
  ArrivalMeter meter("left camera", Duration(33'333'333));
  const auto hears = [&](int stamp_ms, int at_ms) {
    meter.heard(Timestamp(milliseconds(stamp_ms)), kStart + milliseconds(at_ms));
  };
  hears(0, 10);
  hears(33, 43);
  EXPECT_EQ(meter.statistics().jitter_ms, 0.0);
  hears(66, 92);  // 16 ms late
  EXPECT_NEAR(meter.statistics().jitter_ms, 1.0, 1e-9);
  hears(165, 175);
  EXPECT_EQ(meter.statistics().gaps, 1);
  EXPECT_EQ(meter.statistics().longest_gap, milliseconds(99));
  EXPECT_EQ(meter.statistics().packets, 4);
}

Timestamp pair_time(int n) { return Timestamp(Duration(33'333'333) * n); }

/// A head that moves briskly: half a metre a second, and turns.
Transform<World, Rig> head_at(int n) {
  const double t = n / 30.0;
  return {rotation_from_vector({0.0, 1.2 * t, 0.2}), {0.5 * t, 1.6, 0.1}};
}

TEST(HeadTrack, KnowsBetweenPosesAndALittleBeyond) {
  HeadTrack head;
  for (int n = 0; n < 5; ++n) {
    head.add(pair_time(n), head_at(n), 0);
  }
  EXPECT_EQ(head.world_from_rig(pair_time(3)).status, PoseStatus::kMeasured);
  EXPECT_EQ(head.world_from_rig(pair_time(3) + milliseconds(10)).status, PoseStatus::kMeasured);
  const auto ahead = head.world_from_rig(pair_time(5));
  EXPECT_EQ(ahead.status, PoseStatus::kPredicted);
  EXPECT_LT((ahead.value.translation() - head_at(5).translation()).norm(), 1e-9);
  EXPECT_EQ(head.world_from_rig(pair_time(4) + milliseconds(101)).status, PoseStatus::kLost);
  EXPECT_EQ(head.world_from_rig(Timestamp(-Duration(1))).status, PoseStatus::kLost);
}

TEST(HeadTrack, KnowsNothingOfAnotherMapNorAcrossAGap) {
  HeadTrack head;
  head.add(pair_time(0), head_at(0), 0);
  head.add(pair_time(1), head_at(1), 1);
  EXPECT_EQ(head.world_from_rig(pair_time(0)).status, PoseStatus::kLost);
  EXPECT_EQ(head.world_from_rig(pair_time(1)).status, PoseStatus::kMeasured);
  head.add(pair_time(9), head_at(9), 1);
  EXPECT_EQ(head.world_from_rig(pair_time(5)).status, PoseStatus::kLost);
  head.lose();
  EXPECT_EQ(head.world_from_rig(pair_time(9)).status, PoseStatus::kLost);
}

TEST(Uri, NamesHostProfileAndPorts) {
  const auto plain = options_of("//192.168.1.7");
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->host, "192.168.1.7");
  EXPECT_EQ(plain->first_port, 3800);
  EXPECT_EQ(plain->profile, VideoProfile::kRaw);
  const auto all = options_of("//[::1]?profile=h264&port=21000&standin=21019");
  ASSERT_TRUE(all.ok());
  EXPECT_EQ(all->host, "::1");
  EXPECT_EQ(all->first_port, 21000);
  EXPECT_EQ(all->standin_port, 21019);
  EXPECT_EQ(all->profile, VideoProfile::kH264Base);
  EXPECT_EQ(options_of("//192.168.1.7:21000")->first_port, 21000);
  EXPECT_EQ(options_of("//[::1]:21000?scene=off")->first_port, 21000);
}

TEST(Uri, IsRefusedWithWhatIsKnown) {
  const auto refusal = [](const char* text) {
    const auto options = options_of(text);
    return options ? "accepted" : options.error().message;
  };
  EXPECT_THAT(refusal("192.168.1.7"), HasSubstr("//HOST"));
  EXPECT_THAT(refusal("//"), HasSubstr("names no host"));
  EXPECT_THAT(refusal("//a/b"), HasSubstr("must be a name or an address"));
  EXPECT_THAT(
      refusal("//a?prot=1"),
      HasSubstr("profile=raw|h264, stamps=late|exact, scene=on|off, depth=STREAM, port=BASE "
                "and standin=PORT"));
  EXPECT_THAT(refusal("//a?stamps=x"), HasSubstr("stamps \"x\" must be late or exact"));
  EXPECT_EQ(options_of("//a?stamps=exact")->stamps_late, Duration::zero());
  EXPECT_EQ(options_of("//a?stamps=late")->stamps_late, options_of("//a")->stamps_late);
  EXPECT_THAT(refusal("//a?profile=hevc"), HasSubstr("raw or h264"));
  EXPECT_THAT(refusal("//a?depth=both"),
              HasSubstr("depth \"both\" must be ahat, ahat-h264, long-throw or long-throw-png"));
  EXPECT_FALSE(options_of("//a")->depth.has_value());
  EXPECT_EQ(options_of("//a?depth=long-throw-png")->depth->stream, DepthStream::kLongThrow);
  EXPECT_EQ(options_of("//a?depth=long-throw-png")->depth->coding, DepthCoding::kPng);
  EXPECT_EQ(options_of("//a?depth=ahat")->depth->coding, DepthCoding::kRaw);
  EXPECT_THAT(refusal("//a?depth=ahat-hevc"), HasSubstr("depth \"ahat-hevc\" must be"));
  EXPECT_THAT(refusal("//a?port=0"), HasSubstr("from 1 to 65517"));
  EXPECT_THAT(refusal("//a?port=65535"), HasSubstr("from 1 to 65517"));
  EXPECT_THAT(refusal("//a:65518"), HasSubstr("from 1 to 65517"));
  EXPECT_THAT(refusal("//a?port=1&port=2"), HasSubstr("twice"));
  EXPECT_THAT(refusal("//a:1?port=2"), HasSubstr("\"port\" is given twice"));
  EXPECT_THAT(refusal("//::1"), HasSubstr("in brackets"));
  EXPECT_THAT(refusal("//3800"), HasSubstr("must be a name, or four numbers"));
  EXPECT_THAT(refusal("//a?"), HasSubstr("unknown key \"\""));
}

TEST(Faults, AreReadFromText) {
  const auto faults = faults_of("gap=0.25,jump=12,jump=40");
  ASSERT_TRUE(faults.ok());
  EXPECT_EQ(faults->gap, 0.25);
  EXPECT_EQ(faults->jump_at, (std::vector<std::int64_t>{12, 40}));
  EXPECT_GT(faults_of("all")->corrupt, 0.0);
  EXPECT_EQ(faults_of("")->gap, 0.0);
  EXPECT_THAT(faults_of("gap").error().message, HasSubstr("known are gap, lose"));
  EXPECT_THAT(faults_of("gap=2").error().message, HasSubstr("gap must lie in [0, 1]"));
  EXPECT_THAT(faults_of("gap=nan").error().message, HasSubstr("gap must lie"));
  const auto frozen = faults_of("freeze_left=90,lasting=60,clock_back=5,clock_back_s=0.25");
  ASSERT_TRUE(frozen.ok()) << frozen.error().message;
  EXPECT_EQ(frozen->freeze_left, 90);
  EXPECT_FALSE(frozen->strikes(frozen->freeze_left, 89));
  EXPECT_TRUE(frozen->strikes(frozen->freeze_left, 149));
  EXPECT_FALSE(frozen->strikes(frozen->freeze_left, 150));
  EXPECT_EQ(frozen->clock_back_by, milliseconds(250));
  EXPECT_FALSE(frozen->freeze_right.has_value());
  EXPECT_TRUE(faults_of("freeze_poses=0")->strikes(0, 100'000)) << "to the end";
  for (const char* bad : {"freeze_left=1.5", "freeze_left=-1", "only_left", "clock_back_s=0"}) {
    EXPECT_THAT(faults_of(bad).error().message, HasSubstr("is not understood")) << bad;
  }
}

TEST(PairMailbox, TellsALossOnceAndADeathAtEveryQuestion) {
  PairMailbox pairs;
  pairs.fail(Error{"lost"});
  EXPECT_TRUE(pairs.trouble().has_value());
  EXPECT_FALSE(pairs.trouble().has_value()) << "the connection comes back";
  pairs.die(Error{"hl2ss: out of memory"});
  for (int question = 0; question < 3; ++question) {
    const auto trouble = pairs.trouble();
    ASSERT_TRUE(trouble.has_value());
    EXPECT_EQ(trouble->message, "hl2ss: out of memory");
  }
}

TEST(PairMailbox, ShowsItsTapEveryPair) {
  struct Watcher : PairTap {
    std::vector<std::int64_t> sequences;
    void received(const StereoFrame& pair) override {
      EXPECT_EQ(pair.left.pixels.front(), static_cast<std::uint8_t>(pair.sequence));
      sequences.push_back(pair.sequence);
    }
  } seen;
  PairMailbox pairs;
  const auto put = [&](int number) {
    CameraImage left, right;
    left.time = right.time = Timestamp(Duration(number));
    left.image = right.image = GreyImage(2, 1);
    left.image.pixels.front() = static_cast<std::uint8_t>(number);
    pairs.put({left, right}, 0);
  };
  pairs.tap(&seen);
  for (int number = 0; number < 5; ++number) {
    put(number);
  }
  StereoFrame frame;
  EXPECT_TRUE(pairs.take(frame));
  EXPECT_EQ(frame.sequence, 4) << "the newest alone";
  EXPECT_FALSE(pairs.take(frame));
  EXPECT_EQ(seen.sequences, (std::vector<std::int64_t>{0, 1, 2, 3, 4}));
  pairs.tap(nullptr);
  put(5);
  EXPECT_EQ(seen.sequences.size(), 5u);
}

}  // namespace
}  // namespace orthonav::hl2ss
