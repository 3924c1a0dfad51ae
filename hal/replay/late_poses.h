#pragma once

#include "base/time.h"
#include "hal/replay/frame_files.h"

namespace orthonav::replay {

/// Where the head was when each image was taken, from the poses of a recorder that stamps its
/// images late and poses them at the stamp: from one pose to the next at constant velocity, beyond
/// the first pose of a stretch with that after it. A pose that stands alone, with no other within
/// HeadTracker::kMaxHeadPrediction, tells no velocity and is left out.
[[nodiscard]] PosesByTicks poses_at_exposure(const PosesByTicks& at_stamps, Duration late);

}  // namespace orthonav::replay
