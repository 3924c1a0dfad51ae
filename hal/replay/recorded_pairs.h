#pragma once

#include <filesystem>

#include "hal/replay/frame_files.h"
#include "hal/replay/recording.h"

namespace orthonav::replay {

/// A recorder's names for its two front cameras.
struct Sensors {
  const char* left;
  const char* right;
};

/// The pairs of a recorder that does not list them: found by time, numbered in order.
Status add_paired(const std::filesystem::path& folder, const Sensors& sensors,
                  Recording& recording);
/// The pairs that our recorder listed; from a truncated recording, the whole ones.
Status add_listed(const std::filesystem::path& folder, Recording& recording);
/// The poses of the pairs, from the file at `path`, and of the head.
Status add_poses(const std::filesystem::path& path, const PosesByTicks& poses,
                 Recording& recording);

}  // namespace orthonav::replay
