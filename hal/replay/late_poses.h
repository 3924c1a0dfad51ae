#pragma once

#include <cstdint>
#include <vector>

#include "base/time.h"
#include "hal/replay/frame_files.h"

namespace orthonav::replay {

/// Where the head was when each image was taken, from the poses of a recorder that stamps its
/// images late and gives the poses at the stamps: interpolated at constant velocity from one pose
/// to the next; before the first pose of a stretch, extrapolated with the velocity after it. An
/// isolated pose, with no other of its map within HeadTracker::kMaxHeadPrediction, gives no
/// velocity and is left out. `jumps`: the first poses of new maps (`map_jumps`).
[[nodiscard]] PosesByTicks poses_at_exposure(const PosesByTicks& at_stamps, Duration late,
                                             const std::vector<std::int64_t>& jumps = {});

}  // namespace orthonav::replay
