#include <gmock/gmock.h>

#include <cstring>
#include <limits>

#include "base/random.h"
#include "hal/hl2ss/depth_calibration.h"
#include "hal/hl2ss/depth_format.h"
#include "hal/hl2ss/png_decoder.h"
#include "hal/hl2ss/server/depth_bytes.h"
#include "hal/sim/depth_model.h"
#include "tests/hal/hl2ss/hostile_server.h"

namespace orthonav::hl2ss {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<std::uint8_t> ahat_answer() {
  static const auto kAnswer = depth_answer_bytes(sim::calibration_of(sim::hololens2_ahat()));
  return kAnswer;
}

// Where its numbers lie: two tables, a matrix, scale, alias.
constexpr std::size_t kAhatTable = std::size_t{4} * 512 * 512;
constexpr std::size_t kExtrinsicsAt = 2 * kAhatTable;
constexpr std::size_t kScaleAt = kExtrinsicsAt + 64;
constexpr std::size_t kAliasAt = kScaleAt + 4;

std::string refusal_with(std::size_t at, float value) {
  auto answer = ahat_answer();
  std::memcpy(answer.data() + at, &value, sizeof(value));
  const auto read = read_depth_calibration(DepthStream::kAhat, answer);
  return read ? "accepted" : read.error().message;
}

TEST(DepthCalibration, IsRefusedWhereANumberCannotBe) {
  constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal_with(kScaleAt, 1000.0F), "accepted");
  EXPECT_THAT(refusal_with(kScaleAt, 0.0F), HasSubstr("scale 0, must lie in [100, 100000]"));
  EXPECT_THAT(refusal_with(kScaleAt, kNotANumber), HasSubstr("scale nan"));
  EXPECT_THAT(refusal_with(kScaleAt, -1000.0F), HasSubstr("scale -1000"));
  EXPECT_THAT(refusal_with(kAliasAt, 0.0F), HasSubstr("alias 0, must be positive"));
  EXPECT_THAT(refusal_with(kAliasAt, kNotANumber), HasSubstr("alias nan"));
  EXPECT_THAT(refusal_with(kExtrinsicsAt, kNotANumber), HasSubstr("extrinsics"));
  EXPECT_THAT(refusal_with(kExtrinsicsAt, 2.0F), HasSubstr("extrinsics"));
}

TEST(DepthCalibration, OfTheWrongSizeIsRefused) {
  auto answer = ahat_answer();
  ASSERT_THAT(answer, SizeIs(depth_calibration_bytes(DepthStream::kAhat)));
  answer.pop_back();
  const auto read = read_depth_calibration(DepthStream::kAhat, answer);
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, HasSubstr("bytes, must be 4194392"));
  EXPECT_FALSE(read_depth_calibration(DepthStream::kLongThrow, ahat_answer()).ok());
}

/// A NaN pixel has no direction, and neither have those whose centre needs it; if all are NaN,
/// there is no camera.
TEST(DepthCalibration, WithoutDirectionsIsNoCamera) {
  auto answer = ahat_answer();
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  const std::size_t middle = std::size_t{4} * (256 * 512 + 256);
  std::memcpy(answer.data() + middle, &nothing, sizeof(nothing));
  const auto holed = read_depth_calibration(DepthStream::kAhat, answer);
  ASSERT_TRUE(holed.ok()) << holed.error().message;
  EXPECT_EQ(holed->camera.rays[256 * 512 + 256][2], 0.0F);
  EXPECT_GT(holed->camera.rays[260 * 512 + 260][2], 0.0F);
  std::fill_n(answer.begin(), kExtrinsicsAt, std::uint8_t{0xff});
  const auto none = read_depth_calibration(DepthStream::kAhat, answer);
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().message, HasSubstr("no pixel has a direction"));
}

TEST(DepthRanges, AreMillimetresAndNothingWhereNothingWasMeasured) {
  DepthDescription camera;
  camera.camera.stream = DepthStream::kAhat;
  camera.units_per_m = 2000.0;
  const auto ahat = millimetres_of(camera);
  EXPECT_EQ(ahat[0], 0);
  EXPECT_EQ(ahat[4000], 2000);
  EXPECT_EQ(ahat[4089], 2045);
  EXPECT_EQ(ahat[4090], 0);
  EXPECT_EQ(ahat[65535], 0);
  camera.camera.stream = DepthStream::kLongThrow;
  camera.units_per_m = 500.0;
  const auto long_throw = millimetres_of(camera);
  EXPECT_EQ(long_throw[4090], 8180);
  EXPECT_EQ(long_throw[65535], 0) << "no 16 bits of millimetres";
}

TEST(DepthPayload, WhoseSizesContradictIsRefused) {
  const auto split = [](std::uint32_t depth, std::uint32_t rest, std::size_t bytes) {
    std::vector<std::uint8_t> payload;
    append(payload, depth);
    append(payload, rest);
    payload.resize(payload.size() + bytes + 8);
    const auto picture = split_depth(DepthStream::kAhat, payload);
    return !picture ? picture.error().message
                    : (*picture ? std::to_string((*picture)->size()) : "nothing");
  };
  EXPECT_EQ(split(0, 100, 100), "100");
  EXPECT_EQ(split(0, 0, 100), "nothing");
  EXPECT_THAT(split(0, 101, 100), HasSubstr("sizes 0 and 101 of a picture of 100 bytes"));
  EXPECT_THAT(split(0xFFFFFFFF, 0xFFFFFFFF, 100), HasSubstr("sizes 4294967295 and 4294967295"));
  EXPECT_THAT(split(0xFFFFFFFF, 101, 100), HasSubstr("of a picture of 100"));
  EXPECT_FALSE(split_depth(DepthStream::kAhat, std::vector<std::uint8_t>(12)).ok());
  EXPECT_FALSE(split_depth(DepthStream::kAhat, std::vector<std::uint8_t>(8))->has_value());
}

TEST(DepthPng, OfAnotherSizeOrDamagedIsRefused) {
  auto decoder = PngDecoder::create(320, 288);
  ASSERT_TRUE(decoder.ok());
  std::vector<std::uint8_t> bgra;
  DepthFrame frame;
  frame.range_mm = DepthImage(320, 288, 812);
  frame.brightness = DepthImage(320, 288, 99);
  const auto png = long_throw_png(frame);
  ASSERT_TRUE(png.ok());
  for (int again = 0; again < 2; ++again) {
    ASSERT_TRUE((*decoder)->decode(*png, bgra).ok());
    EXPECT_EQ(bgra, raw_depth_bytes(DepthStream::kLongThrow, frame)) << "picture " << again;
  }
  for (const auto& [width, height] :
       {std::pair{288, 320}, {320, 144}, {640, 576}, {40000, 40000}}) {
    auto other = *png;
    // The header's own sizes, whose checksum then fails as well; the smaller ones are made anew.
    for (int i = 0; i < 4; ++i) {
      other[static_cast<std::size_t>(16 + i)] = static_cast<std::uint8_t>(width >> (24 - 8 * i));
      other[static_cast<std::size_t>(20 + i)] = static_cast<std::uint8_t>(height >> (24 - 8 * i));
    }
    EXPECT_FALSE((*decoder)->decode(other, bgra).ok()) << width;
  }
  frame.range_mm = DepthImage(160, 144, 812);
  frame.brightness = DepthImage(160, 144, 99);
  const Status small = (*decoder)->decode(*long_throw_png(frame), bgra);
  ASSERT_FALSE(small.ok());
  EXPECT_THAT(small.error().message, HasSubstr("PNG is 160x144 px"));
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    auto damaged = *png;
    damaged[8 + random.next() % (damaged.size() - 8)] ^= 0x40;
    damaged.resize(damaged.size() - random.next() % 3);
    (void)(*decoder)->decode(damaged, bgra);
  }
  EXPECT_TRUE((*decoder)->decode(*png, bgra).ok()) << "damage is forgotten";
}

std::unique_ptr<Hl2ssHeadset> open_with_depth(HostileServer& server) {
  server.depth_calibration = ahat_answer();
  server.start();
  Hl2ssOptions options = server.client();
  options.depth = DepthWish{DepthStream::kAhat, false};
  auto headset = Hl2ssHeadset::open(options);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  return headset ? std::move(*headset) : nullptr;
}

/// The statistics of the depth stream, which comes last.
const StreamStatistics& depth_of(const ConnectionStatistics& statistics) {
  return statistics.streams.back();
}

TEST(HostileDepth, ThatBehavesIsFollowed) {
  HostileServer server;
  const auto headset = open_with_depth(server);
  ASSERT_NE(headset, nullptr);
  ASSERT_THAT(headset->depth_cameras(), SizeIs(1)) << headset->depth_trouble();
  DepthFrame frame;
  int frames = 0;
  pairs_until(*headset, [&](int pairs, const ConnectionStatistics&) {
    const auto next = headset->depth_cameras().front()->next(frame);
    EXPECT_TRUE(next.ok());
    frames += next && *next == Next::kFrame ? 1 : 0;
    return pairs > 5 && frames > 5;
  });
  EXPECT_EQ(frame.range_mm.at(100, 200), 700);
  EXPECT_EQ(frame.brightness.at(100, 200), 700);
  EXPECT_TRUE(frame.world_from_rig.has_value());
}

TEST(HostileDepth, GarbageHurtsTheDepthStreamAlone) {
  HostileServer server;
  server.depth = [random = Random(7)](std::int64_t) mutable {
    std::vector<std::uint8_t> bytes(random.next() % 5000);
    for (std::uint8_t& byte : bytes) {
      byte = static_cast<std::uint8_t>(random.next());
    }
    return bytes;
  };
  const auto headset = open_with_depth(server);
  ASSERT_NE(headset, nullptr);
  pairs_until(*headset, [&](int pairs, const ConnectionStatistics& statistics) {
    return pairs > 20 && depth_of(statistics).damaged > 2;
  });
  const ConnectionStatistics statistics = headset->statistics();
  EXPECT_EQ(statistics.streams[0].damaged + statistics.streams[1].damaged, 0);
  EXPECT_EQ(statistics.map_moves, 0);
  EXPECT_EQ(statistics.clock_restarts, 0);
}

/// Whole packets with something wrong in each: none becomes a picture, the connection stays.
TEST(HostileDepth, WrongPicturesAreCounted) {
  HostileServer server;
  server.depth = [](std::int64_t turn) {
    auto payload = HostileServer::depth_payload();
    switch (turn % 4) {
      case 0:
        payload.resize(payload.size() / 2);
        break;
      case 1:
        payload[4] = 1;
        break;
      case 2:
        payload.assign(20, 0);
        payload[4] = 4;
        break;
      default:
        payload.erase(payload.begin() + 8, payload.begin() + 16);
        payload[5] = 0xff;
    }
    return HostileServer::depth_packet(turn, payload);
  };
  const auto headset = open_with_depth(server);
  ASSERT_NE(headset, nullptr);
  DepthFrame frame;
  pairs_until(*headset, [&](int pairs, const ConnectionStatistics& statistics) {
    const auto next = headset->depth_cameras().front()->next(frame);
    EXPECT_TRUE(next && *next == Next::kNone);
    return pairs > 10 && depth_of(statistics).damaged > 8;
  });
  EXPECT_EQ(depth_of(headset->statistics()).connections, 1);
}

/// Stamps far ahead would drag the headset's clock along if it listened to them.
TEST(HostileDepth, StampsTeachNobodyTheTime) {
  HostileServer server;
  server.depth = [](std::int64_t turn) {
    auto packet = HostileServer::good_depth(turn);
    const std::uint64_t ahead = static_cast<std::uint64_t>(HostileServer::ticks_of(turn)) +
                                (turn % 2 == 0 ? 50'000'000u : 1'000'000'000'000u);
    std::memcpy(packet.data(), &ahead, sizeof(ahead));
    return packet;
  };
  const auto headset = open_with_depth(server);
  ASSERT_NE(headset, nullptr);
  DepthFrame frame;
  StereoFrame pair;
  pairs_until(*headset, [&](int pairs, const ConnectionStatistics& statistics) {
    EXPECT_EQ(*headset->depth_cameras().front()->next(frame), Next::kNone);
    return pairs > 20 && depth_of(statistics).damaged > 20;
  });
  EXPECT_THAT(depth_of(headset->statistics()).last_trouble,
              ::testing::ContainsRegex("ahead of the headset's clock|10 s from the cameras'"));
  EXPECT_EQ(headset->statistics().clock_restarts, 0);
  // The newest pair still counts as current: the clock was not carried 5 s ahead.
  EXPECT_TRUE(orthonav::test::wait_until([&] {
    const auto next = headset->cameras().next(pair);
    return next && *next == Next::kFrame;
  }));
  EXPECT_LT(seconds(headset->clock().now() - pair.time), 2.0);
}

/// A pose that contradicts the cameras' is of another map: the picture comes without it.
TEST(HostileDepth, PosesOfAnotherMapAreLeftOut) {
  HostileServer server;
  server.depth = [](std::int64_t turn) {
    if (turn % 4 != 0) {
      return std::vector<std::uint8_t>();
    }
    auto packet = packet_bytes(HostileServer::ticks_of(turn), HostileServer::depth_payload());
    append_pose(packet, Transform<World, Rig>(Mat3::identity(), {0.3, 0.0, 0.0}));
    return packet;
  };
  const auto headset = open_with_depth(server);
  ASSERT_NE(headset, nullptr);
  DepthFrame frame;
  int frames = 0;
  pairs_until(*headset, [&](int, const ConnectionStatistics&) {
    const auto next = headset->depth_cameras().front()->next(frame);
    if (next && *next == Next::kFrame) {
      ++frames;
      EXPECT_FALSE(frame.world_from_rig.has_value());
    }
    return frames > 5;
  });
}

TEST(HostileDepth, ThatStallsOrCutsItsConnectionLeavesThePairs) {
  HostileServer server;
  server.depth = [](std::int64_t turn) {
    auto packet = HostileServer::good_depth(turn);
    packet.resize(packet.size() / 2);
    return turn < 40 ? packet : std::vector<std::uint8_t>();
  };
  const auto headset = open_with_depth(server);
  ASSERT_NE(headset, nullptr);
  DepthFrame frame;
  pairs_until(*headset, [&](int pairs, const ConnectionStatistics&) {
    EXPECT_TRUE(headset->depth_cameras().front()->next(frame).ok());
    return pairs > 40;
  });
  EXPECT_EQ(headset->statistics().streams[0].connections, 1);
}

TEST(HostileDepth, WithABadCalibrationIsLeftOutByName) {
  HostileServer server;
  server.depth_calibration = ahat_answer();
  std::fill_n(server.depth_calibration.begin() + kScaleAt, 4, std::uint8_t{0});
  server.start();
  Hl2ssOptions options = server.client();
  options.depth = DepthWish{DepthStream::kAhat, true};
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  EXPECT_THAT((*headset)->depth_cameras(), SizeIs(0));
  EXPECT_THAT((*headset)->depth_trouble(),
              ::testing::ContainsRegex("no depth camera ahat: port [0-9]+: calibration: scale 0"));
  pairs_until(**headset, [](int pairs, const ConnectionStatistics&) { return pairs > 5; });
}

}  // namespace
}  // namespace orthonav::hl2ss
