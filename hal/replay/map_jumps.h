#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "hal/replay/frame_files.h"

namespace orthonav::replay {

/// Recorded map epochs by ticks; a pose belongs to the map of the next pair, or of the last one.
using EpochsByTicks = std::map<std::int64_t, std::int64_t>;
[[nodiscard]] std::int64_t epoch_at(const EpochsByTicks& recorded, std::int64_t ticks);

/// The jumps of the map that a recording does not tell of, found as with a live headset (MapWatch):
/// the ticks of the first pose after each, in order. Where the recording itself changes the map, a
/// jump is no other one.
[[nodiscard]] std::vector<std::int64_t> map_jumps(const PosesByTicks& poses,
                                                  const EpochsByTicks& recorded);

/// How many of the jumps lie at or before a time.
[[nodiscard]] std::int64_t jumps_until(const std::vector<std::int64_t>& jumps, std::int64_t ticks);

}  // namespace orthonav::replay
