#pragma once

#include <filesystem>

#include "hal/replay/frame_files.h"
#include "hal/replay/map_jumps.h"
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
/// The maps of the pairs as recorded.
[[nodiscard]] EpochsByTicks recorded_epochs(const Recording& recording);
/// The poses of the pairs, from the file at `path`, and of the head; and the maps that begin at the
/// jumps (`map_jumps`).
Status add_poses(const std::filesystem::path& path, const PosesByTicks& poses,
                 const std::vector<std::int64_t>& jumps, Recording& recording);

}  // namespace orthonav::replay
