#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "hal/hl2ss/scene_client.h"
#include "tests/hal/hl2ss/scene_peer.h"

namespace orthonav::test {

/// A client and the application at the two ends of a link in simulated time.
class SceneLink {
 public:
  static constexpr Duration kStep = std::chrono::microseconds(1000);
  static constexpr int kStepsAFrame = 17;  ///< a little slower than 60 Hz

  explicit SceneLink(const hl2ss::SceneBudget& budget = {}) : client(budget) {
    client.connected(now_.host);
  }
  /// From now on everything takes this long each way.
  void delay(Duration one_way) { one_way_ = one_way; }
  /// The next message, and all that follow it, arrive at least `late` later than they would.
  void lose_next(Duration late) { lost_for_ = late; }
  [[nodiscard]] Timestamp now() const { return now_.headset; }
  [[nodiscard]] HostTime host() const { return now_.host; }

  /// A millisecond passes: messages that are due are delivered, and every 17th time the application
  /// makes a frame.
  void step() {
    now_.host += kStep;
    now_.headset += kStep;
    const auto bytes = client.next(now_);
    sent_bytes += bytes.size();
    if (!bytes.empty()) {
      last_sent = bytes;
    }
    send(bytes);
    for (; !to_peer_.empty() && to_peer_.front().first <= now_.host; to_peer_.pop_front()) {
      peer.hear(to_peer_.front().second);
    }
    for (; !to_client_.empty() && to_client_.front().first <= now_.host; to_client_.pop_front()) {
      if (status) {
        status = client.answered(to_client_.front().second, now_);
      }
    }
    if (++steps_ % kStepsAFrame != 0) {
      return;
    }
    for (const std::uint32_t answer : peer.frame()) {
      if (connected && one_way_ == Duration{} && status) {
        status = client.answered(answer, now_);
      } else if (connected) {
        to_client_.emplace_back(now_.host + one_way_, answer);
      }
    }
    ++frames;
  }
  /// The client gives the connection up, which loses everything on its way, and reconnects at once.
  void reconnect() {
    to_peer_.clear();
    to_client_.clear();
    peer.left();
    client.connected(now_.host);
  }
  void run(Duration time) {
    for (Duration passed{}; passed < time; passed += kStep) {
      step();
    }
  }
  [[nodiscard]] int visible() const {
    int count = 0;
    for (const auto& [id, thing] : peer.things) {
      count += thing.visible ? 1 : 0;
    }
    return count;
  }
  /// Whether the text of a tool is visible.
  [[nodiscard]] bool shows(const std::string& words) const {
    for (const auto& [id, thing] : peer.things) {
      if (thing.visible && thing.words == words) {
        return true;
      }
    }
    return false;
  }

  hl2ss::SceneClient client;
  ScenePeer peer;
  Status status;
  bool connected = true;  ///< false: nothing gets through either way
  std::size_t sent_bytes = 0;
  std::vector<std::uint8_t> last_sent;
  int frames = 0;

 private:
  /// In order, as TCP delivers.
  void send(const std::vector<std::uint8_t>& bytes) {
    if (!connected || bytes.empty()) {
      return;
    }
    HostTime arrives = now_.host + one_way_ + std::exchange(lost_for_, Duration{});
    if (!to_peer_.empty()) {
      arrives = std::max(arrives, to_peer_.back().first);
    }
    to_peer_.emplace_back(arrives, bytes);
  }

  Duration one_way_{};
  Duration lost_for_{};
  std::deque<std::pair<HostTime, std::vector<std::uint8_t>>> to_peer_;
  std::deque<std::pair<HostTime, std::uint32_t>> to_client_;
  hl2ss::SceneMoment now_{HostTime(std::chrono::seconds(100)), Timestamp(std::chrono::seconds(7))};
  int steps_ = 0;
};

inline DisplayObject ball(std::uint64_t key, Vec3 position_m) {
  DisplayObject object;
  object.key = key;
  object.position_m = position_m;
  object.scale = {0.003, 0.003, 0.003};
  return object;
}

inline DisplayObject readout(std::uint64_t key, const std::string& text) {
  DisplayObject object = ball(key, {0, 0, -0.5});
  object.shape = ObjectShape::kText;
  object.follows_tool = true;
  object.scale = {1, 1, 1};
  object.text = text;
  object.cap_height_m = 0.0069;
  return object;
}

}  // namespace orthonav::test
