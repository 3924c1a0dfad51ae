#include "hal/replay/depth_files.h"

#include <algorithm>
#include <array>
#include <utility>

#include "hal/replay/calibration_files.h"
#include "hal/replay/frame_files.h"
#include "hal/replay/hololens1_files.h"
#include "hal/replay/layout.h"
#include "hal/replay/map_jumps.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

/// AHaT marks unmeasured pixels with 4090 and more; HoloLens 1 stores millimetres in 12 bits, so
/// such values are not measurements there either.
constexpr std::uint16_t kInvalidFromMm = 4090;

/// A stream with its name in a recorder.
struct Sensor {
  const char* name;
  DepthStream stream;
  std::uint16_t invalid_from_mm;
  bool hololens1;
};
constexpr std::array<Sensor, 5> kSensors = {{
    {kAhatSensor, DepthStream::kAhat, kInvalidFromMm, false},
    {kLongThrowSensor, DepthStream::kLongThrow, 0, false},
    {kShortThrowSensor, DepthStream::kShortThrow, 0, false},
    {kHololens1ShortThrow, DepthStream::kShortThrow, kInvalidFromMm, true},
    {kHololens1LongThrow, DepthStream::kLongThrow, kInvalidFromMm, true},
}};

ImageLayout layout_of(const Sensor& sensor) {
  if (sensor.hololens1) {
    return {hololens1_prefix(sensor.name), PixelKind::kLittleEndian16, 0, 0, false};
  }
  return {"", PixelKind::kBigEndian16, 0, 0, true};
}

/// The frames of a recorder that does not list them: the images in the order of time.
Status add_images(const std::filesystem::path& path, std::int64_t epoch, RecordedDepth& depth) {
  for (const ImageMember& member : depth.images.members()) {
    const auto time = named_time(path, member.ticks, epoch);
    if (!time) {
      return time.error();
    }
    const auto sequence = static_cast<std::int64_t>(depth.frames.size());
    depth.frames.push_back({sequence, *time, *time, member, std::nullopt, std::nullopt, 0});
  }
  return {};
}

/// The frames that our recorder listed.
Status add_listed(const std::filesystem::path& path, std::int64_t epoch, RecordedDepth& depth) {
  const auto rows = read_frames(path);
  if (!rows) {
    return rows.error();
  }
  const auto& members = depth.images.members();
  const std::size_t whole = std::min(rows->size(), members.size());
  const bool is_cut = !depth.images.cut().empty() || is_torn_file(path);
  if (whole == 0) {
    return file_error(path, "holds no whole frame: it was cut off before its first one");
  }
  if (rows->size() != members.size() && !is_cut) {
    return file_error(path, "lists " + std::to_string(rows->size()) +
                                " frames, the archive holds " + std::to_string(members.size()));
  }
  for (std::size_t i = 0; i < whole; ++i) {
    const FrameRow& row = (*rows)[i];
    if (row.ticks != members[i].ticks) {
      return file_error(path, "sequence " + std::to_string(row.sequence) + " has ticks " +
                                  std::to_string(row.ticks) + ", its image " +
                                  std::to_string(members[i].ticks));
    }
    if (Status s = check_row(path, row, epoch); !s) {
      return s;
    }
    if (row.clock < row.time) {
      return file_error(
          path, "sequence " + std::to_string(row.sequence) + ": clock_ns lies before time_ns");
    }
    depth.frames.push_back(
        {row.sequence, row.time, row.clock, members[i], std::nullopt, std::nullopt, 0});
  }
  return {};
}

/// Assigns each brightness image to the frame of its time.
void add_brightness(RecordedDepth& depth) {
  const auto& images = depth.images.brightness();
  auto image = images.begin();
  std::int64_t used = 0;
  for (RecordedDepthFrame& frame : depth.frames) {
    while (image != images.end() && image->ticks < frame.range.ticks) {
      ++image;
    }
    if (image == images.end() || image->ticks != frame.range.ticks) {
      continue;
    }
    frame.brightness = *image;
    ++used;
  }
  depth.summary.brightness_unpaired = static_cast<std::int64_t>(images.size()) - used;
}

/// The poses, and the maps that begin where they jump.
void add_poses(const PosesByTicks& poses, RecordedDepth& depth) {
  EpochsByTicks recorded;
  for (const RecordedDepthFrame& frame : depth.frames) {
    recorded.emplace(frame.range.ticks, frame.map_epoch);
  }
  const auto jumps = map_jumps(poses, recorded);
  for (RecordedDepthFrame& frame : depth.frames) {
    frame.map_epoch += jumps_until(jumps, frame.range.ticks);
    const auto found = poses.find(frame.range.ticks);
    if (found != poses.end()) {
      frame.world_from_rig = found->second;
    } else {
      ++depth.summary.frames_without_pose;
    }
  }
}

Status read_hololens1(const std::filesystem::path& folder, const Sensor& sensor,
                      RecordedDepth& depth) {
  const auto frames = read_hololens1_depth(folder, sensor.name);
  if (!frames) {
    return frames.error();
  }
  add_poses(frames->world_from_rig, depth);
  const int width_px = depth.images.width_px();
  const int height_px = depth.images.height_px();
  auto rays = read_hololens1_rays(folder, sensor.name, width_px, height_px);
  if (!rays) {
    return rays.error();
  }
  depth.calibration = {sensor.stream, width_px, height_px, std::move(*rays),
                       frames->camera_from_rig};
  return {};
}

Status read_hololens2(const std::filesystem::path& folder, const Sensor& sensor,
                      RecordedDepth& depth) {
  const auto poses = read_poses(poses_of(folder, sensor.name));
  if (!poses) {
    return poses.error();
  }
  add_poses(*poses, depth);
  auto calibration = read_depth_calibration(folder, sensor.name, sensor.stream,
                                            depth.images.width_px(), depth.images.height_px());
  if (!calibration) {
    return calibration.error();
  }
  depth.calibration = std::move(*calibration);
  return {};
}

Result<std::int64_t> own_epoch(const std::filesystem::path& folder, const ImageTar& images) {
  if (is_there(folder / kDeviceFile)) {
    const auto device = read_device(folder / kDeviceFile);
    if (!device) {
      return device.error();
    }
    if (device->epoch_ticks_100ns) {
      return *device->epoch_ticks_100ns;
    }
  }
  return epoch_of(images.members().front().ticks);
}

Status read_depth(const std::filesystem::path& folder, const Sensor& sensor,
                  std::optional<std::int64_t> epoch_ticks, RecordedDepth& depth) {
  const auto tar = tar_of(folder, sensor.name);
  auto images = ImageTar::open(tar, layout_of(sensor));
  if (!images) {
    return images.error();
  }
  depth.images = std::move(*images);
  depth.invalid_from_mm = sensor.invalid_from_mm;
  const auto epoch = epoch_ticks ? Result(*epoch_ticks) : own_epoch(folder, depth.images);
  if (!epoch) {
    return epoch.error();
  }
  const auto list = frames_of(folder, sensor.name);
  if (Status s = is_there(list) ? add_listed(list, *epoch, depth) : add_images(tar, *epoch, depth);
      !s) {
    return s;
  }
  add_brightness(depth);
  if (Status s = add_map_moves(map_of(folder, sensor.name), depth.frames); !s) {
    return s;
  }
  return sensor.hololens1 ? read_hololens1(folder, sensor, depth)
                          : read_hololens2(folder, sensor, depth);
}

}  // namespace

Status RecordedDepth::read(const RecordedDepthFrame& recorded, DepthFrame& frame) {
  if (Status s = images.read(recorded.range, frame.range_mm); !s) {
    return s;
  }
  if (invalid_from_mm != 0) {
    for (std::uint16_t& range_mm : frame.range_mm.pixels) {
      if (range_mm >= invalid_from_mm) {
        range_mm = 0;
      }
    }
  }
  frame.brightness.clear();
  if (recorded.brightness) {
    if (Status s = images.read(*recorded.brightness, frame.brightness); !s) {
      return s;
    }
  }
  frame.sequence = recorded.sequence;
  frame.map_epoch = recorded.map_epoch;
  frame.time = recorded.time;
  frame.world_from_rig = recorded.world_from_rig;
  return {};
}

RecordedDepths read_depths(const std::filesystem::path& folder,
                           std::optional<std::int64_t> epoch_ticks) {
  RecordedDepths depths;
  for (const Sensor& sensor : kSensors) {
    if (!is_there(tar_of(folder, sensor.name))) {
      continue;
    }
    RecordedDepth depth;
    depth.summary.stream = sensor.stream;
    if (const Status status = read_depth(folder, sensor, epoch_ticks, depth); !status) {
      depth.summary.trouble = status.error().message;
      depths.unreadable.push_back(std::move(depth.summary));
      continue;
    }
    depth.summary.width_px = depth.calibration.width_px;
    depth.summary.height_px = depth.calibration.height_px;
    depth.summary.frames = static_cast<std::int64_t>(depth.frames.size());
    depth.summary.cut = depth.images.cut();
    depth.summary.repeated = depth.images.repeated();
    depth.summary.first_ticks_100ns = depth.frames.front().range.ticks;
    depth.summary.last_ticks_100ns = depth.frames.back().range.ticks;
    depths.streams.push_back(std::move(depth));
  }
  return depths;
}

}  // namespace orthonav::replay
