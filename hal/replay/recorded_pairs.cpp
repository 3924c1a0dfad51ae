#include "hal/replay/recorded_pairs.h"

#include <algorithm>
#include <utility>

#include "hal/replay/layout.h"
#include "hal/replay/pairing.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

Status add_paired(const std::filesystem::path& folder, const Sensors& sensors,
                  Recording& recording) {
  const auto& left = recording.left.members();
  const auto& right = recording.right.members();
  const auto path = tar_of(folder, sensors.left);
  // The lists are sorted, so checking their ends is enough for every difference.
  for (const std::int64_t ticks :
       {left.front().ticks, left.back().ticks, right.front().ticks, right.back().ticks}) {
    if (auto time = named_time(path, ticks, recording.epoch_ticks_100ns); !time) {
      return time.error();
    }
  }
  constexpr std::int64_t kWithinTicks = kPairWithin / Duration(100);
  for (const auto& [l, r] : paired(left, right, kWithinTicks)) {
    const Timestamp time = *device_time(l.ticks, recording.epoch_ticks_100ns);
    const auto sequence = static_cast<std::int64_t>(recording.pairs.size());
    recording.pairs.push_back({sequence, time, time, l, r, std::nullopt});
  }
  if (recording.pairs.empty()) {
    return file_error(folder, "holds no stereo pair: no two images of " +
                                  std::string(sensors.left) + " and " + sensors.right +
                                  " lie within 11.1 ms, a third of a frame");
  }
  return {};
}

Status add_listed(const std::filesystem::path& folder, Recording& recording) {
  const auto path = folder / kFramesFile;
  const auto rows = read_frames(path);
  if (!rows) {
    return rows.error();
  }
  const auto& left = recording.left.members();
  const auto& right = recording.right.members();
  // In a truncated recording, one file may hold more than another. A pair is whole if all of them
  // hold it.
  const std::size_t whole = std::min({rows->size(), left.size(), right.size()});
  if (whole == 0) {
    return file_error(folder, "holds no whole pair: it was cut off before its first one");
  }
  const bool is_same = rows->size() == left.size() && rows->size() == right.size();
  if (!is_same && recording.summary.cut.empty()) {
    return file_error(path, "lists " + std::to_string(rows->size()) + " pairs, the archives hold " +
                                std::to_string(left.size()) + " left and " +
                                std::to_string(right.size()) + " right images");
  }
  for (std::size_t i = 0; i < whole; ++i) {
    const FrameRow& row = (*rows)[i];
    if (row.ticks != left[i].ticks || row.ticks != right[i].ticks) {
      return file_error(path, "pair " + std::to_string(row.sequence) + " has ticks " +
                                  std::to_string(row.ticks) + ", its images " +
                                  std::to_string(left[i].ticks) + " and " +
                                  std::to_string(right[i].ticks));
    }
    if (Status s = check_row(path, row, recording.epoch_ticks_100ns); !s) {
      return s;
    }
    recording.pairs.push_back({row.sequence, row.time, row.clock, left[i], right[i], std::nullopt});
  }
  return {};
}

EpochsByTicks recorded_epochs(const Recording& recording) {
  EpochsByTicks epochs;
  for (const RecordedPair& pair : recording.pairs) {
    epochs.emplace(pair.left.ticks, pair.map_epoch);
  }
  return epochs;
}

Status add_poses(const std::filesystem::path& path, const PosesByTicks& poses,
                 const std::vector<std::int64_t>& jumps, Recording& recording) {
  const EpochsByTicks recorded = recorded_epochs(recording);
  std::map<std::int64_t, Timestamp> exact_times;
  for (RecordedPair& pair : recording.pairs) {
    exact_times.emplace(pair.left.ticks, pair.time);
    pair.map_epoch += jumps_until(jumps, pair.left.ticks);
    const auto found = poses.find(pair.left.ticks);
    if (found != poses.end()) {
      pair.world_from_rig = found->second;
    } else {
      ++recording.summary.pairs_without_pose;
    }
  }
  std::vector<HeadSample> samples;
  samples.reserve(poses.size());
  std::int64_t jumped = 0;
  for (const auto& [ticks, pose] : poses) {
    const auto exact = exact_times.find(ticks);
    const auto time = exact != exact_times.end()
                          ? Result<Timestamp>(exact->second)
                          : named_time(path, ticks, recording.epoch_ticks_100ns);
    if (!time) {
      return time.error();
    }
    samples.push_back({*time, pose, epoch_at(recorded, ticks) + jumps_until(jumps, ticks)});
    if (std::exchange(jumped, jumps_until(jumps, ticks)) != jumps_until(jumps, ticks)) {
      recording.jumps.push_back(*time);
    }
  }
  recording.head = HeadHistory(std::move(samples));
  recording.summary.map_jumps = static_cast<std::int64_t>(jumps.size());
  return {};
}

}  // namespace orthonav::replay
