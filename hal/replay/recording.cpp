#include "hal/replay/recording.h"

#include <algorithm>
#include <utility>

#include "hal/replay/calibration_files.h"
#include "hal/replay/frame_files.h"
#include "hal/replay/hololens1_files.h"
#include "hal/replay/layout.h"
#include "hal/replay/pairing.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

/// What a recorder calls its two front cameras.
struct Sensors {
  const char* left;
  const char* right;
};
constexpr Sensors kStreamRecorder{kLeftSensor, kRightSensor};
constexpr Sensors kHololens1{kHololens1Left, kHololens1Right};

Status check_folder(const std::filesystem::path& folder) {
  std::error_code code;
  if (!is_there(folder)) {
    return file_error(folder, "no such recording");
  }
  if (!std::filesystem::is_directory(folder, code)) {
    return file_error(
        folder,
        "is no folder; a recording is a folder with \"VLC LF.tar\" or \"vlc_lf.tar\" in it");
  }
  return {};
}

/// The pairs of a StreamRecorder folder: found by time, numbered in order.
Status add_paired(const std::filesystem::path& folder, const Sensors& sensors,
                  Recording& recording) {
  const auto& left = recording.left.members();
  const auto& right = recording.right.members();
  const auto path = tar_of(folder, sensors.left);
  // The lists are sorted: their ends tell whether every difference fits.
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
                                  " lie within 1 ms");
  }
  return {};
}

/// The pairs that our recorder listed.
Status add_listed(const std::filesystem::path& folder, Recording& recording) {
  const auto path = folder / kFramesFile;
  const auto rows = read_frames(path);
  if (!rows) {
    return rows.error();
  }
  const auto& left = recording.left.members();
  const auto& right = recording.right.members();
  if (rows->size() != left.size() || rows->size() != right.size()) {
    return file_error(path, "lists " + std::to_string(rows->size()) + " pairs, the archives hold " +
                                std::to_string(left.size()) + " left and " +
                                std::to_string(right.size()) + " right images");
  }
  for (std::size_t i = 0; i < rows->size(); ++i) {
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

Status add_poses(const std::filesystem::path& path, const PosesByTicks& poses,
                 Recording& recording) {
  std::map<std::int64_t, Timestamp> exact_times;
  std::map<std::int64_t, std::int64_t> map_epochs;
  for (RecordedPair& pair : recording.pairs) {
    exact_times.emplace(pair.left.ticks, pair.time);
    map_epochs.emplace(pair.left.ticks, pair.map_epoch);
    const auto found = poses.find(pair.left.ticks);
    if (found != poses.end()) {
      pair.world_from_rig = found->second;
    } else {
      ++recording.summary.pairs_without_pose;
    }
  }
  std::vector<HeadSample> samples;
  samples.reserve(poses.size());
  for (const auto& [ticks, pose] : poses) {
    const auto exact = exact_times.find(ticks);
    const auto time = exact != exact_times.end()
                          ? Result<Timestamp>(exact->second)
                          : named_time(path, ticks, recording.epoch_ticks_100ns);
    if (!time) {
      return time.error();
    }
    // A pose without a pair lies in the map of the pair after it, or of the last one.
    const auto epoch = map_epochs.lower_bound(ticks);
    samples.push_back(
        {*time, pose, (epoch == map_epochs.end() ? std::prev(epoch) : epoch)->second});
  }
  recording.head = HeadHistory(std::move(samples));
  return {};
}

Status add_own_files(const std::filesystem::path& folder, Recording& recording) {
  if (is_there(folder / kEventsFile)) {
    auto events = read_events(folder / kEventsFile);
    if (!events) {
      return events.error();
    }
    recording.events = std::move(*events);
  }
  if (is_there(folder / kHeadFile)) {
    auto answers = read_head_answers(folder / kHeadFile);
    if (!answers) {
      return answers.error();
    }
    recording.head_answers = std::move(*answers);
  }
  if (is_there(folder / kToolsFile)) {
    constexpr std::uintmax_t kMaxToolsBytes = 1 << 20;
    auto tools = read_text(folder / kToolsFile, kMaxToolsBytes);
    if (!tools) {
      return tools.error();
    }
    recording.tools_json = std::move(*tools);
  }
  return {};
}

/// A recording that does not say it began one nominal frame before its first pair.
Timestamp nominal_start(const Recording& recording) {
  constexpr Duration kNominalFrame = std::chrono::nanoseconds(33'333'333);
  return recording.pairs.front().clock - kNominalFrame;
}

Status add_device(const std::filesystem::path& folder, Recording& recording) {
  RecordedDevice device;
  if (is_there(folder / kDeviceFile)) {
    const auto read = read_device(folder / kDeviceFile);
    if (!read) {
      return read.error();
    }
    device = *read;
  }
  const std::int64_t first_ticks = recording.left.members().front().ticks;
  recording.epoch_ticks_100ns = device.epoch_ticks_100ns.value_or(epoch_of(first_ticks));
  recording.display_latency = device.display_latency;
  const bool listed = is_there(folder / kFramesFile);
  if (Status s =
          listed ? add_listed(folder, recording) : add_paired(folder, kStreamRecorder, recording);
      !s) {
    return s;
  }
  recording.clock_start = device.clock_start.value_or(nominal_start(recording));
  if (recording.clock_start > recording.pairs.front().clock) {
    return file_error(folder / kDeviceFile, "clock_start_ns lies after the first pair's clock_ns");
  }
  return {};
}

Status open_archives(const std::filesystem::path& folder, const Sensors& sensors,
                     Recording& recording) {
  // HoloLens 1 puts its images into folders.
  const auto layout = [&](const char* sensor) {
    return ImageLayout{sensors.left == kHololens1Left ? hololens1_prefix(sensor) : ""};
  };
  auto left = ImageTar::open(tar_of(folder, sensors.left), layout(sensors.left));
  if (!left) {
    return left.error();
  }
  auto right = ImageTar::open(tar_of(folder, sensors.right), layout(sensors.right));
  if (!right) {
    return right.error();
  }
  recording.left = std::move(*left);
  recording.right = std::move(*right);
  return {};
}

/// StreamRecorder's and our own.
Status read_hololens2(const std::filesystem::path& folder, Recording& recording) {
  if (Status s = open_archives(folder, kStreamRecorder, recording); !s) {
    return s;
  }
  if (Status s = add_device(folder, recording); !s) {
    return s;
  }
  if (Status s = add_map_moves(folder / kMapFile, recording.pairs); !s) {
    return s;
  }
  const auto path = poses_of(folder, kLeftSensor);
  const auto poses = read_poses(path);
  if (!poses) {
    return poses.error();
  }
  // The right camera's file says the same again; it is read for its damage only.
  if (auto same = read_poses(poses_of(folder, kRightSensor)); !same) {
    return same.error();
  }
  if (Status s = add_poses(path, *poses, recording); !s) {
    return s;
  }
  if (Status s = add_own_files(folder, recording); !s) {
    return s;
  }
  auto calibration = read_calibration(folder);
  if (!calibration) {
    return calibration.error();
  }
  recording.calibration = std::move(*calibration);
  return {};
}

Status read_hololens1(const std::filesystem::path& folder, Recording& recording) {
  if (Status s = open_archives(folder, kHololens1, recording); !s) {
    return s;
  }
  recording.epoch_ticks_100ns = epoch_of(recording.left.members().front().ticks);
  if (Status s = add_paired(folder, kHololens1, recording); !s) {
    return s;
  }
  recording.clock_start = nominal_start(recording);
  const auto left = read_hololens1_left(folder);
  if (!left) {
    return left.error();
  }
  const auto right = read_hololens1_right(folder);
  if (!right) {
    return right.error();
  }
  if (Status s = add_poses(folder / (std::string(kHololens1Left) + ".csv"), left->world_from_rig,
                           recording);
      !s) {
    return s;
  }
  auto left_camera = read_hololens1_camera(folder, kHololens1Left);
  if (!left_camera) {
    return left_camera.error();
  }
  auto right_camera = read_hololens1_camera(folder, kHololens1Right);
  if (!right_camera) {
    return right_camera.error();
  }
  recording.calibration = {std::move(*left_camera), std::move(*right_camera), left->camera_from_rig,
                           right->camera_from_rig};
  return {};
}

void add_depth(const std::filesystem::path& folder, Recording& recording) {
  RecordedDepths depths = read_depths(folder, recording.epoch_ticks_100ns);
  recording.depth = std::move(depths.streams);
  recording.summary.depth = std::move(depths.unreadable);
  for (const RecordedDepth& depth : recording.depth) {
    recording.summary.depth.push_back(depth.summary);
  }
}

}  // namespace

Result<Recording> read_recording(const std::filesystem::path& folder) {
  if (Status s = check_folder(folder); !s) {
    return s.error();
  }
  Recording recording;
  const bool hololens1 = is_there(tar_of(folder, kHololens1Left));
  if (Status s = hololens1 ? read_hololens1(folder, recording) : read_hololens2(folder, recording);
      !s) {
    return s.error();
  }
  RecordingSummary& summary = recording.summary;
  summary.pairs = static_cast<std::int64_t>(recording.pairs.size());
  summary.first_ticks_100ns = recording.pairs.front().left.ticks;
  summary.last_ticks_100ns = recording.pairs.back().left.ticks;
  summary.left_unpaired =
      static_cast<std::int64_t>(recording.left.members().size()) - summary.pairs;
  summary.right_unpaired =
      static_cast<std::int64_t>(recording.right.members().size()) - summary.pairs;
  summary.repeated = recording.left.repeated() + recording.right.repeated();
  add_depth(folder, recording);
  return recording;
}

}  // namespace orthonav::replay
