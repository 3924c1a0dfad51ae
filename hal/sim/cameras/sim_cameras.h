#pragma once

#include <memory>
#include <vector>

#include "hal/sim/cameras/stereo_renderer.h"
#include "hal/sim/sim_room.h"

namespace orthonav::sim {

/// The simulated headset's cameras. Each pair advances the room, or, in real time, is taken when it
/// is due.
class SimCameras final : public StereoCamera {
 public:
  /// The room must outlive it. The images are rendered with the actual calibration.
  SimCameras(SimRoom& room, const SimOptions& options, StereoCalibration reported,
             StereoCalibration actual);

 private:
  [[nodiscard]] const StereoCalibration& do_calibration() const override { return reported_; }
  /// A perfect camera or a perfect head tracker in a room at rest.
  [[nodiscard]] MayRepeat do_may_repeat() const override;
  Result<Next> do_next(StereoFrame& frame) override;

  [[nodiscard]] Timestamp time_of(std::int64_t number) const;
  [[nodiscard]] Timestamp delivery_of(std::int64_t number) const;
  void expose(Timestamp time, StereoFrame& frame) ORTHONAV_REQUIRES(room_.mutex);
  void render(StereoFrame& frame);

  SimRoom& room_;
  SimOptions options_;
  Duration half_exposure_;
  StereoCalibration reported_;
  std::vector<RoomState> states_;  ///< over the exposure
  std::unique_ptr<StereoRenderer> renderer_;
  std::int64_t number_ = 1;  ///< of the next frame
};

}  // namespace orthonav::sim
