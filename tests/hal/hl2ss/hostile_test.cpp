#include <gmock/gmock.h>

#include "base/random.h"
#include "base/sanitizers.h"
#include "tests/hal/hl2ss/hostile_server.h"

namespace orthonav::hl2ss {
namespace {

TEST(HostileServer, ThatBehavesIsFollowed) {
  HostileServer server;
  server.start();
  const auto headset = Hl2ssHeadset::open(server.client());
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  pairs_until(**headset, [](int pairs, const ConnectionStatistics&) { return pairs > 20; });
}

TEST(HostileServer, GarbageOnAnyPortHurtsThatPortAlone) {
  const auto garbage = [random = Random(7)](std::int64_t) mutable {
    std::vector<std::uint8_t> bytes(random.next() % 5000);
    for (std::uint8_t& byte : bytes) {
      byte = static_cast<std::uint8_t>(random.next());
    }
    return bytes;
  };
  HostileServer server;
  server.voice = garbage;
  server.start();
  const auto headset = Hl2ssHeadset::open(server.client());
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  pairs_until(**headset, [](int pairs, const ConnectionStatistics& statistics) {
    return pairs > 20 && statistics.streams[2].damaged > 0;
  });
  EXPECT_EQ((*headset)->statistics().streams[0].damaged, 0);
}

TEST(HostileServer, StampsThatRunBackwardsMakeNoPairs) {
  HostileServer server;
  server.left = [](std::int64_t turn) { return HostileServer::good_image(1000 - turn, 0); };
  server.right = [](std::int64_t turn) { return HostileServer::good_image(1000 - turn, 0); };
  server.start();
  const auto headset = Hl2ssHeadset::open(server.client());
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  const int pairs = pairs_until(**headset, [](int, const ConnectionStatistics& statistics) {
    return statistics.unpaired > 40;
  });
  EXPECT_LE(pairs, 1);
}

TEST(HostileServer, ImagesOfNoSizeAndNanPosesAreCounted) {
  HostileServer server;
  server.left = [](std::int64_t turn) {
    auto packet = HostileServer::good_image(turn, 0);
    if (turn % 3 == 1) {
      packet = image_packet(HostileServer::ticks_of(turn), std::vector<std::uint8_t>(100), {});
      append_pose(packet, Transform<World, Rig>{});
    }
    if (turn % 3 == 2) {
      std::fill(packet.end() - 64, packet.end(), std::uint8_t{0xff});
    }
    return packet;
  };
  server.start();
  const auto headset = Hl2ssHeadset::open(server.client());
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  pairs_until(**headset, [](int pairs, const ConnectionStatistics& statistics) {
    return pairs > 10 && statistics.streams[0].damaged > 20;
  });
}

TEST(HostileServer, SaysHowManyImagesWereRefusedForTheirStamps) {
  HostileServer server;
  server.left = server.right = [](std::int64_t turn) {
    auto packet = HostileServer::good_image(turn, 0);
    std::fill_n(packet.begin(), 8, std::uint8_t{0xff});
    return packet;
  };
  server.start();
  Hl2ssOptions options = server.client();
  // Enough for the calibrations, which come first.
  options.open_within = std::chrono::milliseconds(sanitized() ? 6000 : 600);
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_FALSE(headset.ok());
  EXPECT_THAT(
      headset.error().message,
      ::testing::ContainsRegex("no pair of images within [0-9.]+ s; left camera: [0-9]+ packets "
                               "refused, the last one: stamp 18446744073709551615"));
}

TEST(HostileServer, ACalibrationThatIsNoneIsRefusedByName) {
  HostileServer server;
  server.start();
  Hl2ssOptions options = server.client();
  options.first_port = server.client().first_port + 15;  // voice answers instead
  options.open_within = std::chrono::milliseconds(400);
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_FALSE(headset.ok());
  EXPECT_THAT(headset.error().message, ::testing::HasSubstr("127.0.0.1: "));
}

}  // namespace
}  // namespace orthonav::hl2ss
