#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/mutex.h"
#include "hal/api/depth_camera.h"
#include "hal/api/wearer.h"
#include "hal/hl2ss/server/server.h"

namespace orthonav::hl2ss {

/// The served headset, which exists as long as a session. One thread begins and ends sessions and
/// takes the pairs, another one shows frames.
class ServedHeadset {
 public:
  /// The first one is opened beforehand, for the calibration.
  ServedHeadset(Server::OpenHeadset open, std::unique_ptr<Headset> first)
      : open_(std::move(open)), headset_(std::move(first)) {}

  /// The cameras' answers in mode 2, without directions in an edge of this width in pixels. Only
  /// before the first session ends.
  [[nodiscard]] std::vector<std::uint8_t> left_calibration(int unmapped_edge_px) const;
  [[nodiscard]] std::vector<std::uint8_t> right_calibration(int unmapped_edge_px) const;
  /// A depth camera's; empty if there is none of this kind.
  [[nodiscard]] std::vector<std::uint8_t> depth_calibration(DepthStream stream) const;

  /// Opens the headset if there is none; it stays until the session ends. `prepare` runs before
  /// anything is shown.
  Result<Headset*> begin_session(const std::function<void(Headset&)>& prepare);
  void end_session();
  /// Shows the frame to the wearer if a session is running. `back` converts from the client's
  /// world to the headset's.
  void show(const Transform<World, World>& back, WornFrame& frame);

 private:
  Server::OpenHeadset open_;
  mutable Mutex mutex_;  ///< guards its creation and end; its parts may be used from two threads
  std::unique_ptr<Headset> headset_ ORTHONAV_GUARDED_BY(mutex_);
  bool in_session_ ORTHONAV_GUARDED_BY(mutex_) = false;
};

}  // namespace orthonav::hl2ss
