#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "base/random.h"
#include "hal/hl2ss/calibration.h"
#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/hl2ss/server/packets.h"
#include "hal/hl2ss/server/port.h"
#include "hal/hl2ss/spatial_input.h"
#include "hal/hl2ss/voice.h"
#include "hal/sim/hololens2.h"
#include "tests/hal/hl2ss/served_room.h"

#include <poll.h>

namespace orthonav::hl2ss {
namespace {

/// A server whose every port says what a test wants, over and over.
class HostileServer {
 public:
  using Words = std::function<std::vector<std::uint8_t>(std::int64_t turn)>;
  Words left = [](std::int64_t turn) { return good_image(turn, 0); };
  Words right = [](std::int64_t turn) { return good_image(turn, 1'500); };
  Words spatial = [](std::int64_t turn) {
    return packet_bytes(ticks_of(turn), spatial_input_bytes(std::nullopt));
  };
  Words voice = [](std::int64_t) { return voice_answer_bytes({}); };

  static std::int64_t ticks_of(std::int64_t turn) { return 1'000'000'000 + turn * 333'333; }
  static std::vector<std::uint8_t> good_image(std::int64_t turn, std::int64_t later) {
    const GreyImage picture(640, 480, static_cast<std::uint8_t>(turn));
    auto packet = image_packet(ticks_of(turn) + later, picture.pixels,
                               {static_cast<std::uint64_t>(100 * ticks_of(turn)), 1, 1});
    append_pose(packet, Transform<World, Rig>{});
    return packet;
  }

  void start() {
    const StereoCalibration c = sim::hololens2_calibration();
    left_calibration_ = calibration_bytes(c.left, c.left_from_rig.row_major());
    right_calibration_ = calibration_bytes(c.right, c.right_from_rig.row_major());
    const auto host = net::resolve("127.0.0.1");
    ASSERT_TRUE(host.ok());
    for (base_ = 30000; base_ < 60000; base_ += 20) {
      bool free = true;
      for (std::size_t i = 0; i < ports_.size() && free; ++i) {
        free = ports_[i]->listen(*host, base_ + kOffsets[i]).ok();
      }
      if (free) {
        break;
      }
    }
    thread_ = std::thread([this] { serve(); });
  }
  ~HostileServer() {
    stop_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  [[nodiscard]] Hl2ssOptions client() const {
    Hl2ssOptions options;
    options.host = "127.0.0.1";
    options.first_port = base_;
    return options;
  }

 private:
  static constexpr std::array kOffsets = {0, 2, 12, 15};

  void serve() {
    while (!stop_) {
      std::vector<pollfd> watched;
      for (Port* port : ports_) {
        watched.push_back({port->fd(), port->events(), 0});
      }
      (void)::poll(watched.data(), watched.size(), 2);
      for (std::size_t i = 0; i < ports_.size(); ++i) {
        ports_[i]->step(watched[i].revents, HostClock::now());
      }
      const auto now = HostClock::now();
      if (now - last_turn_ < std::chrono::milliseconds(5)) {
        continue;
      }
      last_turn_ = now;
      ++turn_;
      if (streams_left_) {
        left_port_.send({{left(turn_)}});
      }
      if (streams_right_) {
        right_port_.send({{right(turn_)}});
      }
      spatial_port_.send({{spatial(turn_)}});
      voice_port_.send({{voice(turn_)}});
    }
  }
  Result<std::size_t> camera(Port& port, const std::vector<std::uint8_t>& calibration,
                             bool& streams, Bytes said) {
    if (said[0] == 2) {
      port.send({{calibration}});
    }
    streams = said[0] != 2;
    return said.size();
  }
  static Result<std::size_t> listen(Bytes said) { return said.size(); }

  std::vector<std::uint8_t> left_calibration_;
  std::vector<std::uint8_t> right_calibration_;
  bool streams_left_ = false;
  bool streams_right_ = false;
  Port left_port_{
      {[this](Bytes said) { return camera(left_port_, left_calibration_, streams_left_, said); },
       [] {}, [this] { streams_left_ = false; }}};
  Port right_port_{
      {[this](Bytes said) { return camera(right_port_, right_calibration_, streams_right_, said); },
       [] {}, [this] { streams_right_ = false; }}};
  Port spatial_port_{{listen}};
  Port voice_port_{{listen}};
  std::array<Port*, 4> ports_ = {&left_port_, &right_port_, &spatial_port_, &voice_port_};
  int base_ = 0;
  std::int64_t turn_ = 0;
  HostTime last_turn_{};
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// Looks on until there was enough to see, or far too long; how many pairs came.
int pairs_until(Hl2ssHeadset& headset,
                const std::function<bool(int, const ConnectionStatistics&)>& enough) {
  StereoFrame frame;
  std::vector<Phrase> phrases;
  int pairs = 0;
  const bool came = orthonav::test::wait_until([&] {
    if (enough(pairs, headset.statistics())) {
      return true;
    }
    const auto next = headset.cameras().next(frame);
    pairs += next && *next == Next::kFrame ? 1 : 0;
    EXPECT_TRUE(headset.voice().poll(headset.clock().now(), phrases).ok());
    (void)headset.head().world_from_rig(headset.clock().now());
    return false;
  });
  EXPECT_TRUE(came) << "too little came";
  return pairs;
}

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
  server.spatial = garbage;
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
  server.spatial = [](std::int64_t) { return std::vector<std::uint8_t>(); };
  server.start();
  const auto headset = Hl2ssHeadset::open(server.client());
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  const int pairs = pairs_until(**headset, [](int, const ConnectionStatistics& statistics) {
    return statistics.streams[0].out_of_order > 20;
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
  server.spatial = [](std::int64_t) { return std::vector<std::uint8_t>(); };
  server.start();
  Hl2ssOptions options = server.client();
  options.open_within = std::chrono::milliseconds(600);
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_FALSE(headset.ok());
  EXPECT_THAT(headset.error().message,
              ::testing::ContainsRegex("no image within 0.6.* s; left camera: [0-9]+ packets "
                                       "refused, the last one: stamp 18446744073709551615"));
}

TEST(HostileServer, ACalibrationThatIsNoneIsRefusedByName) {
  HostileServer server;
  server.start();
  Hl2ssOptions options = server.client();
  options.first_port = server.client().first_port + 12;  // spatial input answers instead
  options.open_within = std::chrono::milliseconds(400);
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_FALSE(headset.ok());
  EXPECT_THAT(headset.error().message, ::testing::HasSubstr("127.0.0.1: "));
}

}  // namespace
}  // namespace orthonav::hl2ss
