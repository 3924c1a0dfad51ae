#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "base/mutex.h"
#include "hal/hl2ss/depth_reader.h"

namespace orthonav::hl2ss {

class Receiver;

/// A headset's depth stream, on a thread of its own, so that it can never delay the cameras.
class DepthReceiver final : private StampTeller {
 public:
  /// `cameras` provides time and map, and must outlive it.
  static Result<std::unique_ptr<DepthReceiver>> start(const net::Endpoint& host,
                                                      const Hl2ssOptions& options,
                                                      DepthDescription described,
                                                      const Receiver& cameras);
  ~DepthReceiver() override;
  DepthReceiver(const DepthReceiver&) = delete;
  DepthReceiver& operator=(const DepthReceiver&) = delete;

  [[nodiscard]] DepthCamera& camera() { return camera_; }
  [[nodiscard]] StreamStatistics statistics() const;

 private:
  class Camera final : public DepthCamera {
   public:
    explicit Camera(DepthReceiver& receiver) : receiver_(receiver) {}

   private:
    [[nodiscard]] const DepthCalibration& do_calibration() const override {
      return receiver_.described_.camera;
    }
    Result<Next> do_next(DepthFrame& frame) override;
    DepthReceiver& receiver_;
  };
  DepthReceiver(DepthDescription described, const Receiver& cameras, Duration interval);
  [[nodiscard]] Result<Timestamp> told(std::uint64_t ticks, HostTime at) const override;
  void run() ORTHONAV_EXCLUDES(mutex_);

  DepthDescription described_;
  const Receiver& cameras_;
  DepthMailbox pictures_;
  Camera camera_{*this};
  std::atomic<bool> stop_ = false;
  net::WakeUp wake_up_;
  mutable Mutex mutex_;
  ArrivalMeter meter_ ORTHONAV_GUARDED_BY(mutex_);
  std::unique_ptr<DepthReader> reader_ ORTHONAV_GUARDED_BY(mutex_);
  std::unique_ptr<Connection> connection_ ORTHONAV_GUARDED_BY(mutex_);
  std::thread thread_;
};

}  // namespace orthonav::hl2ss
