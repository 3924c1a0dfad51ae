#pragma once

#include "base/time.h"
#include "hal/replay/frame_files.h"

namespace orthonav::replay {

/// Where the head was when each image was taken, from the poses of a recorder that stamps its
/// images late and gives the poses at the stamps: interpolated at constant velocity from one pose
/// to the next; before the first pose of a stretch, extrapolated with the velocity after it. An
/// isolated pose, with no other within HeadTracker::kMaxHeadPrediction, gives no velocity and is
/// left out.
[[nodiscard]] PosesByTicks poses_at_exposure(const PosesByTicks& at_stamps, Duration late);

}  // namespace orthonav::replay
