#pragma once

#include <poll.h>

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "hal/hl2ss/calibration.h"
#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/hl2ss/server/packets.h"
#include "hal/hl2ss/server/port.h"
#include "hal/hl2ss/voice.h"
#include "hal/sim/cameras/hololens2.h"
#include "tests/support/wait_until.h"

namespace orthonav::hl2ss {

/// A server whose ports send what a test wants, over and over: one turn every 5 ms, with stamps 33
/// ms apart.
class HostileServer {
 public:
  using Words = std::function<std::vector<std::uint8_t>(std::int64_t turn)>;
  Words left = [](std::int64_t turn) { return good_image(turn, 0); };
  Words right = [](std::int64_t turn) { return good_image(turn, 1'500); };
  /// AHaT's port: raw pictures of 700 mm, every fourth turn.
  Words depth = [](std::int64_t turn) {
    return turn % 4 == 0 ? good_depth(turn) : std::vector<std::uint8_t>();
  };
  std::vector<std::uint8_t> depth_calibration;  ///< empty: it does not answer
  Words voice = [](std::int64_t) { return voice_answer_bytes({}); };

  static std::int64_t ticks_of(std::int64_t turn) { return 1'000'000'000 + turn * 333'333; }
  static std::vector<std::uint8_t> good_image(std::int64_t turn, std::int64_t later) {
    const GreyImage picture(640, 480, static_cast<std::uint8_t>(turn));
    auto packet = image_packet(ticks_of(turn) + later, picture.pixels,
                               {static_cast<std::uint64_t>(100 * ticks_of(turn)), 1, 1});
    append_pose(packet, Transform<World, Rig>(Mat3::identity(), {1e-5 * double(turn), 0, 0}));
    return packet;
  }
  static std::vector<std::uint8_t> depth_payload() {
    std::vector<std::uint8_t> payload;
    append(payload, std::uint32_t{0});
    append(payload, std::uint32_t{4 * 512 * 512});
    for (int i = 0; i < 2 * 512 * 512; ++i) {
      append(payload, std::uint16_t{700});
    }
    append(payload, std::uint64_t{1});
    return payload;
  }
  static std::vector<std::uint8_t> good_depth(std::int64_t turn) {
    return depth_packet(turn, depth_payload());
  }
  static std::vector<std::uint8_t> depth_packet(std::int64_t turn, Bytes payload) {
    auto packet = packet_bytes(ticks_of(turn), payload);
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
    options.phrases = {"go"};
    return options;
  }

 private:
  static constexpr std::array kOffsets = {0, 2, 15, 4};

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
      if (streams_depth_) {
        depth_port_.send({{depth(turn_)}});
      }
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
  bool streams_depth_ = false;
  Port depth_port_{
      {[this](Bytes said) { return camera(depth_port_, depth_calibration, streams_depth_, said); },
       [] {}, [this] { streams_depth_ = false; }}};
  Port voice_port_{{listen}};
  std::array<Port*, 4> ports_ = {&left_port_, &right_port_, &voice_port_, &depth_port_};
  int base_ = 0;
  std::int64_t turn_ = 0;
  HostTime last_turn_{};
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// Takes pairs until there are enough or too much time has passed; returns how many came.
inline int pairs_until(Hl2ssHeadset& headset,
                       const std::function<bool(int, const ConnectionStatistics&)>& enough) {
  StereoFrame frame;
  std::vector<Phrase> phrases;
  int pairs = 0;
  const bool came = orthonav::test::wait_until([&] {
    if (enough(pairs, headset.statistics())) {
      return true;
    }
    const auto next = headset.cameras()->next(frame);
    pairs += next && *next == Next::kFrame ? 1 : 0;
    EXPECT_TRUE(headset.voice().poll(headset.clock().now(), phrases).ok());
    (void)headset.head().world_from_rig(headset.clock().now());
    return false;
  });
  EXPECT_TRUE(came) << "too little came";
  return pairs;
}

}  // namespace orthonav::hl2ss
