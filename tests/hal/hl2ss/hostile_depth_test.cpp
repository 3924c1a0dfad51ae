#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "base/random.h"
#include "tests/hal/hl2ss/ahat_answer.h"
#include "tests/hal/hl2ss/hostile_server.h"

namespace orthonav::hl2ss::depth_parser_test {
namespace {

using ::testing::SizeIs;

std::unique_ptr<Hl2ssHeadset> open_with_depth(HostileServer& server) {
  server.depth_calibration = ahat_answer();
  server.start();
  Hl2ssOptions options = server.client();
  options.depth = DepthWish{DepthStream::kAhat, DepthCoding::kRaw};
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
                                (turn % 2 == 0 ? 90'000'000u : 1'000'000'000'000u);
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
  // The newest pair still counts as current: the clock was not carried 9 s ahead. The server's
  // stamps may lag by seconds, since they count its turns and a busy machine lets it wait.
  EXPECT_TRUE(orthonav::test::wait_until([&] {
    const auto next = headset->cameras()->next(pair);
    return next && *next == Next::kFrame;
  }));
  EXPECT_LT(seconds(headset->clock().now() - pair.time), 8.0);
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
  options.depth = DepthWish{DepthStream::kAhat, DepthCoding::kH264};
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  EXPECT_THAT((*headset)->depth_cameras(), SizeIs(0));
  EXPECT_THAT((*headset)->depth_trouble(),
              ::testing::ContainsRegex("no depth camera ahat: port [0-9]+: calibration: scale 0"));
  pairs_until(**headset, [](int pairs, const ConnectionStatistics&) { return pairs > 5; });
}

}  // namespace
}  // namespace orthonav::hl2ss::depth_parser_test
