#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/mutex.h"
#include "hal/api/depth_camera.h"
#include "hal/hl2ss/server/depth_request.h"
#include "hal/hl2ss/server/port.h"
#include "hal/hl2ss/server/video_encoder.h"

namespace orthonav::hl2ss {

/// A depth camera's port: answers with the calibration, or streams the pictures it is given.
/// Without a calibration, the headset has no such camera and every client is disconnected.
class DepthPort {
 public:
  /// `calibration`: the complete answer in mode 2.
  DepthPort(DepthStream stream, std::vector<std::uint8_t> calibration)
      : stream_(stream), calibration_(std::move(calibration)) {}
  [[nodiscard]] Port& port() { return port_; }
  [[nodiscard]] DepthStream stream() const { return stream_; }
  [[nodiscard]] bool is_streaming() const;
  /// Sends a picture to the client that asked for them, unless it has left meanwhile; its pose is
  /// in the client's World.
  Status send(const DepthFrame& frame);

 private:
  Result<std::size_t> understand(Bytes said);
  Result<std::vector<std::uint8_t>> pictured(const DepthAsked& asked, std::int64_t stream,
                                             const DepthFrame& frame);

  DepthStream stream_;
  std::vector<std::uint8_t> calibration_;
  mutable Mutex mutex_;
  std::optional<DepthAsked> asked_ ORTHONAV_GUARDED_BY(mutex_);
  std::int64_t requests_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::int64_t encoded_request_ = -1;
  std::int64_t pictures_ = 0;
  std::unique_ptr<VideoEncoder> encoder_;
  Port port_{{[this](Bytes said) { return understand(said); }, [] {},
              [this] {
                const MutexLock lock(mutex_);
                asked_.reset();
              }}};
};

}  // namespace orthonav::hl2ss
