#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hal/replay/recording.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

/// rig2world.txt: pose by ticks. Lines may come in any order; two for one time must agree.
using PosesByTicks = std::map<std::int64_t, Transform<World, Rig>>;
Result<PosesByTicks> read_poses(const std::filesystem::path& path);
void append_pose(std::string& line, std::int64_t ticks, const Transform<World, Rig>& pose);

/// frames.csv: the data of a pair that ticks can't hold.
struct FrameRow {
  std::int64_t sequence = 0;
  Timestamp time{};
  std::int64_t ticks = 0;
  Timestamp clock{};
};
Result<std::vector<FrameRow>> read_frames(const std::filesystem::path& path);
void append_frame(std::string& line, const FrameRow& row);

/// map.csv: the first pair of each map except the first one; there is no such file if the map never
/// changes.
struct MapRow {
  std::int64_t sequence = 0;
  std::int64_t map_epoch = 0;
};
Result<std::vector<MapRow>> read_map_moves(const std::filesystem::path& path);
void append_map_move(std::string& line, const MapRow& row);

/// Gives pairs or frames the maps from such a file, if there is one.
template <class Frame>
Status add_map_moves(const std::filesystem::path& path, std::vector<Frame>& frames) {
  if (!is_there(path)) {
    return {};
  }
  const auto rows = read_map_moves(path);
  if (!rows) {
    return rows.error();
  }
  for (const MapRow& row : *rows) {
    for (Frame& frame : frames) {
      if (frame.sequence >= row.sequence) {
        frame.map_epoch = row.map_epoch;
      }
    }
  }
  return {};
}

/// device.csv
Result<RecordedDevice> read_device(const std::filesystem::path& path);
std::string device_text(const RecordedDevice& device);

/// The epoch of a recording that does not state it, and times since an epoch: nothing if they do
/// not fit.
[[nodiscard]] std::int64_t epoch_of(std::int64_t first_ticks);
[[nodiscard]] std::optional<Timestamp> device_time(std::int64_t ticks, std::int64_t epoch_ticks);
/// The same for a time stated in the file at `path`, which an Error names.
Result<Timestamp> named_time(const std::filesystem::path& path, std::int64_t ticks,
                             std::int64_t epoch_ticks);
/// Checks that a row's exact time agrees with its ticks.
Status check_row(const std::filesystem::path& path, const FrameRow& row, std::int64_t epoch_ticks);

}  // namespace orthonav::replay
