#pragma once

#include "hal/replay/depth_files.h"
#include "hal/replay/replay_clock.h"

namespace orthonav::replay {

/// A recorded depth stream as a camera, on the clock of the replay's pairs (ReplayPace). Borrows
/// everything.
class ReplayDepth : public DepthCamera {
 public:
  ReplayDepth(RecordedDepth& depth, Progress& progress, const Clock& clock, ReplayPace pace)
      : depth_(depth), progress_(progress), clock_(clock), pace_(pace) {}

 private:
  RecordedDepth& depth_;
  Progress& progress_;
  const Clock& clock_;
  ReplayPace pace_;
  std::size_t next_ = 0;

  [[nodiscard]] const DepthCalibration& do_calibration() const override {
    return depth_.calibration;
  }
  Result<Next> do_next(DepthFrame& frame) override;
  bool due();
};

}  // namespace orthonav::replay
