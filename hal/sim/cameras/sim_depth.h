#pragma once

#include <cstdint>
#include <vector>

#include "hal/sim/cameras/depth_sensor.h"
#include "hal/sim/sim_room.h"

namespace orthonav::sim {

/// A depth camera of the simulated headset, with a rate of its own: renders on request the pictures
/// up to the last pair, in order. A caller that is late misses the oldest, as with a real camera.
/// May be read by a separate thread.
class SimDepth final : public DepthCamera {
 public:
  /// The room must outlive it.
  SimDepth(SimRoom& room, const SimOptions& options, const DepthModel& model);

 private:
  [[nodiscard]] const DepthCalibration& do_calibration() const override {
    return renderer_.calibration();
  }
  Result<Next> do_next(DepthFrame& frame) override;
  [[nodiscard]] Timestamp time_of(std::int64_t number) const;
  /// The number of the last picture no later than the last pair, up to which the room is known.
  [[nodiscard]] std::int64_t newest() const ORTHONAV_REQUIRES(room_.mutex);

  SimRoom& room_;
  double rate_hz_;
  std::int64_t most_waiting_;  ///< pictures
  Random random_;
  DepthRenderer renderer_;
  DepthSensorErrors sensor_;
  std::int64_t last_ = 0;  ///< number of the last picture
  RoomState state_;
  std::vector<DepthSight> sights_;
};

}  // namespace orthonav::sim
