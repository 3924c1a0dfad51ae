#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "base/mutex.h"
#include "hal/api/devices.h"
#include "hal/hl2ss/server/depth_port.h"

namespace orthonav::hl2ss {

/// The depth cameras of the served headset, each with its port. Pictures that no client wants are
/// not taken.
class DepthSender {
 public:
  /// The arguments are the answers in mode 2, empty if there is no such camera.
  DepthSender(std::vector<std::uint8_t> ahat, std::vector<std::uint8_t> long_throw)
      : ahat_(DepthStream::kAhat, std::move(ahat)),
        long_throw_(DepthStream::kLongThrow, std::move(long_throw)) {}
  ~DepthSender();
  DepthSender(const DepthSender&) = delete;
  DepthSender& operator=(const DepthSender&) = delete;

  [[nodiscard]] DepthPort& ahat() { return ahat_; }
  [[nodiscard]] DepthPort& long_throw() { return long_throw_; }
  /// Converts poses from the headset's world to the client's, which may have jumped.
  using ClientFromWorld = std::function<Transform<World, World>()>;
  /// `follows_pairs`: pictures are taken when `send_due` is called; otherwise on a separate thread,
  /// since a picture of a simulated room takes a while.
  void start(ClientFromWorld client_from_world, bool follows_pairs);
  /// A session with this headset begins; the headset must exist until the session ends.
  void begin(Headset& headset);
  void end();
  /// Sends every picture that is due of each stream that a client wants.
  void send_due();

 private:
  void run();
  /// Sends one picture of each; whether there was any.
  bool send_next();
  bool send_next(DepthPort& port) ORTHONAV_REQUIRES(mutex_);

  DepthPort ahat_;
  DepthPort long_throw_;
  ClientFromWorld client_from_world_;
  std::atomic<bool> stop_ = false;
  Mutex mutex_;  ///< held while a picture is taken: a session ends after it
  Headset* headset_ ORTHONAV_GUARDED_BY(mutex_) = nullptr;
  DepthFrame frame_ ORTHONAV_GUARDED_BY(mutex_);
  std::thread thread_;
};

}  // namespace orthonav::hl2ss
