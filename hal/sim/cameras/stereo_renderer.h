#pragma once

#include <memory>
#include <span>
#include <thread>

#include "base/mutex.h"
#include "hal/api/devices.h"
#include "hal/sim/cameras/room_renderer.h"

namespace orthonav::sim {

/// Renders both cameras' images at the same time, the right one on a thread of its own. The images
/// depend only on the arguments.
class StereoRenderer {
 public:
  StereoRenderer(const RoomDescription& room, const ErrorModel& error_model,
                 StereoCalibration cameras, std::uint64_t seed);
  ~StereoRenderer();
  StereoRenderer(const StereoRenderer&) = delete;
  StereoRenderer& operator=(const StereoRenderer&) = delete;

  /// Fills both images of the frame with this number. One thread at a time.
  void render(std::span<const RoomState> states, std::int64_t number, StereoFrame& frame);

 private:
  struct Job {
    std::span<const RoomState> states;
    std::uint64_t noise_seed = 0;
    GreyImage* image = nullptr;  ///< null: nothing to do
  };
  void work();

  StereoCalibration cameras_;
  std::uint64_t seed_;
  std::unique_ptr<RoomRenderer> left_;
  std::unique_ptr<RoomRenderer> right_;
  Mutex mutex_;
  ConditionVariable changed_;
  Job job_ ORTHONAV_GUARDED_BY(mutex_);
  bool stop_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::thread worker_;
};

}  // namespace orthonav::sim
