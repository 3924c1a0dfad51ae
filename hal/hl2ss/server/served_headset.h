#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/mutex.h"
#include "hal/api/depth_camera.h"
#include "hal/hl2ss/server/server.h"

namespace orthonav::hl2ss {

/// The headset that is served: it comes with a session and goes with it. One thread begins and ends
/// sessions and takes the pairs, another shows.
class ServedHeadset {
 public:
  /// The first is there already, for the calibration.
  ServedHeadset(Server::OpenHeadset open, std::unique_ptr<Headset> first)
      : open_(std::move(open)), headset_(std::move(first)) {}

  /// The cameras' answers in mode 2; without a direction along the edges, so many pixels wide. Only
  /// before the first session ends.
  [[nodiscard]] std::vector<std::uint8_t> left_calibration(int unmapped_edge_px) const;
  [[nodiscard]] std::vector<std::uint8_t> right_calibration(int unmapped_edge_px) const;
  /// A depth camera's; empty where it has none of this kind.
  [[nodiscard]] std::vector<std::uint8_t> depth_calibration(DepthStream stream) const;

  /// Opens it where there is none; it stays until the session ends. `prepare` is done before
  /// anything is shown.
  Result<Headset*> begin_session(const std::function<void(Headset&)>& prepare);
  void end_session();
  /// Where a session is on. `back` leads from the client's world to the headset's.
  void show(const Transform<World, World>& back, ShownFrame& frame);

 private:
  Server::OpenHeadset open_;
  mutable Mutex mutex_;  ///< of its coming and going; its parts may be used from two threads
  std::unique_ptr<Headset> headset_ ORTHONAV_GUARDED_BY(mutex_);
  bool in_session_ ORTHONAV_GUARDED_BY(mutex_) = false;
};

}  // namespace orthonav::hl2ss
