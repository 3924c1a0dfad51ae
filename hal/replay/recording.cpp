#include "hal/replay/recording.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "hal/replay/calibration_files.h"
#include "hal/replay/frame_files.h"
#include "hal/replay/hololens1_files.h"
#include "hal/replay/late_poses.h"
#include "hal/replay/layout.h"
#include "hal/replay/recorded_pairs.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

constexpr Sensors kStreamRecorder{kLeftSensor, kRightSensor};
constexpr Sensors kHololens1{kHololens1Left, kHololens1Right};

Status check_folder(const std::filesystem::path& folder) {
  std::error_code code;
  if (!is_there(folder)) {
    return file_error(folder, "no such recording", ErrorCode::kNotFound);
  }
  if (!std::filesystem::is_directory(folder, code)) {
    return file_error(
        folder,
        "is not a folder; a recording is a folder with \"VLC LF.tar\" or \"vlc_lf.tar\" in it");
  }
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

/// A recording that does not state its start began one nominal frame before its first pair.
Timestamp nominal_start(const Recording& recording) {
  constexpr Duration kNominalFrame = std::chrono::nanoseconds(33'333'333);
  return recording.pairs.front().clock - kNominalFrame;
}

/// How late the front cameras' files are stamped.
Duration lateness(const RecordedDevice& device, bool is_ours, RecordedStamps stamps) {
  if (stamps == RecordedStamps::kExact) {
    return Duration::zero();
  }
  return device.stamps_late.value_or(is_ours ? Duration::zero() : kResearchModeStampsLate);
}

Status add_device(const std::filesystem::path& folder, RecordedStamps stamps,
                  Recording& recording) {
  RecordedDevice device;
  bool is_ours = is_there(folder / kFramesFile);
  if (is_there(folder / kDeviceFile)) {
    const auto read = read_device(folder / kDeviceFile);
    if (!read) {
      return read.error();
    }
    device = *read;
    is_ours = true;
  }
  const std::int64_t first_ticks = recording.left.members().front().ticks;
  recording.stamps_late = lateness(device, is_ours, stamps);
  // The files' ticks are late. Time zero is moved by the same amount, so that each pair has its
  // true time and keeps its ticks in the files.
  recording.epoch_ticks_100ns = device.epoch_ticks_100ns.value_or(epoch_of(first_ticks)) +
                                recording.stamps_late / Duration(100);
  recording.display_latency = device.display_latency;
  recording.may_repeat = device.may_repeat;
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

/// Checks the files that our recorder writes line by line, and the poses.
void note_torn_lines(const std::filesystem::path& folder, Recording& recording) {
  const bool is_ours = is_there(folder / kFramesFile);
  for (const std::filesystem::path& path :
       {folder / kFramesFile, folder / kMapFile, folder / kEventsFile, folder / kHeadFile,
        poses_of(folder, kLeftSensor), poses_of(folder, kRightSensor)}) {
    // Other recorders may omit the end of their last line.
    if ((is_ours || !recording.summary.cut.empty()) && is_there(path) && is_torn_file(path)) {
      note_cut(path.filename().string() + " ends within a line", recording.summary.cut);
    }
  }
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
  for (const ImageTar* archive : {&recording.left, &recording.right}) {
    note_cut(archive->cut(), recording.summary.cut);
  }
  return {};
}

/// The rig's poses, from the left camera's file; the right one's holds the same and is read only to
/// detect damage.
Status add_camera_poses(const std::filesystem::path& folder, Recording& recording) {
  const auto path = poses_of(folder, kLeftSensor);
  const auto poses = read_poses(path);
  if (!poses) {
    return poses.error();
  }
  if (auto same = read_poses(poses_of(folder, kRightSensor)); !same) {
    return same.error();
  }
  // Ticks that are not a valid time are damage, even for a pose that the correction would leave
  // out.
  if (!poses->empty()) {
    for (const std::int64_t ticks : {poses->begin()->first, poses->rbegin()->first}) {
      if (auto time = named_time(path, ticks, recording.epoch_ticks_100ns); !time) {
        return time.error();
      }
    }
  }
  const auto jumps = map_jumps(*poses, recorded_epochs(recording));
  const bool is_late = recording.stamps_late != Duration::zero();
  return add_poses(path, is_late ? poses_at_exposure(*poses, recording.stamps_late, jumps) : *poses,
                   jumps, recording);
}

/// StreamRecorder's and our own.
Status read_hololens2(const std::filesystem::path& folder, RecordedStamps stamps,
                      Recording& recording) {
  if (Status s = open_archives(folder, kStreamRecorder, recording); !s) {
    return s;
  }
  note_torn_lines(folder, recording);
  if (Status s = add_device(folder, stamps, recording); !s) {
    return s;
  }
  if (Status s = add_map_moves(folder / kMapFile, recording.pairs); !s) {
    return s;
  }
  if (Status s = add_camera_poses(folder, recording); !s) {
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
                           map_jumps(left->world_from_rig, recorded_epochs(recording)), recording);
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
  // Depth stamps are not late: they count from the unmoved time zero.
  RecordedDepths depths =
      read_depths(folder, recording.epoch_ticks_100ns - recording.stamps_late / Duration(100));
  recording.depth = std::move(depths.streams);
  recording.summary.depth = std::move(depths.unreadable);
  for (const RecordedDepth& depth : recording.depth) {
    recording.summary.depth.push_back(depth.summary);
    note_cut(depth.summary.cut, recording.summary.cut);
  }
}

}  // namespace

Result<Recording> read_recording(const std::filesystem::path& folder, RecordedStamps stamps) {
  if (Status s = check_folder(folder); !s) {
    return s.error();
  }
  Recording recording;
  const bool hololens1 = is_there(tar_of(folder, kHololens1Left));
  if (Status s =
          hololens1 ? read_hololens1(folder, recording) : read_hololens2(folder, stamps, recording);
      !s) {
    return s.error();
  }
  RecordingSummary& summary = recording.summary;
  summary.pairs = static_cast<std::int64_t>(recording.pairs.size());
  // Numbers come from a file and may be far apart.
  const auto numbers = static_cast<std::uint64_t>(recording.pairs.back().sequence) -
                       static_cast<std::uint64_t>(recording.pairs.front().sequence) + 1;
  summary.missing = static_cast<std::int64_t>(std::min(
      numbers - recording.pairs.size(), std::uint64_t{std::numeric_limits<std::int64_t>::max()}));
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
