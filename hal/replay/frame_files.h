#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hal/replay/recording.h"

namespace orthonav::replay {

/// rig2world.txt: pose by ticks. Lines may come in any order; two for one time must agree.
using PosesByTicks = std::map<std::int64_t, Transform<World, Rig>>;
Result<PosesByTicks> read_poses(const std::filesystem::path& path);
void append_pose(std::string& line, std::int64_t ticks, const Transform<World, Rig>& pose);

/// frames.csv: what ticks cannot hold of a pair.
struct FrameRow {
  std::int64_t sequence = 0;
  Timestamp time{};
  std::int64_t ticks = 0;
  Timestamp clock{};
};
Result<std::vector<FrameRow>> read_frames(const std::filesystem::path& path);
void append_frame(std::string& line, const FrameRow& row);

/// map.csv: the first pair of each map but the first; there is none while the map stays.
struct MapRow {
  std::int64_t sequence = 0;
  std::int64_t map_epoch = 0;
};
Result<std::vector<MapRow>> read_map_moves(const std::filesystem::path& path);
void append_map_move(std::string& line, const MapRow& row);

/// device.csv
Result<RecordedDevice> read_device(const std::filesystem::path& path);
std::string device_text(const RecordedDevice& device);

/// The epoch of a recording that does not name it, and times since an epoch: nothing where they do
/// not fit.
[[nodiscard]] std::int64_t epoch_of(std::int64_t first_ticks);
[[nodiscard]] std::optional<Timestamp> device_time(std::int64_t ticks, std::int64_t epoch_ticks);

}  // namespace orthonav::replay
