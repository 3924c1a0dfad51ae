#include "hal/replay/frame_files.h"

#include "hal/replay/layout.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

constexpr std::uintmax_t kMaxPosesBytes = std::uintmax_t{1} << 30U;
constexpr std::uintmax_t kMaxFramesBytes = std::uintmax_t{1} << 30U;
constexpr std::uintmax_t kMaxDeviceBytes = 4096;

Status take_pose(std::string_view line, std::vector<std::string_view>& fields,
                 PosesByTicks& poses) {
  split(line, fields);
  if (fields.size() != 17) {
    return Error{"holds " + std::to_string(fields.size()) + " values, must be 17 (ticks, matrix)"};
  }
  const auto ticks = parse_integer(fields[0]);
  if (!ticks || *ticks < 0) {
    return Error{"ticks must be a whole number"};
  }
  const auto pose = parse_pose<World, Rig>(fields, 1, kMaxWorldM);
  if (!pose) {
    return Error{"world_from_rig: " + pose.error().message};
  }
  // A frame written twice must have the same pose; a contradiction is damage.
  const auto [entry, added] = poses.emplace(*ticks, *pose);
  if (!added && entry->second != *pose) {
    return Error{"ticks " + std::to_string(*ticks) + " have another pose already"};
  }
  return {};
}

Status take_frame(std::string_view line, std::vector<std::string_view>& fields,
                  std::vector<FrameRow>& rows) {
  split(line, fields);
  if (fields.size() != 4) {
    return Error{"holds " + std::to_string(fields.size()) + " values, must be 4"};
  }
  std::array<std::int64_t, 4> values{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto value = parse_integer(fields[i]);
    if (!value) {
      return Error{"value " + std::to_string(i + 1) + " must be a whole number"};
    }
    if (*value < -kMaxNs || *value > kMaxNs) {
      return Error{"value " + std::to_string(i + 1) + " must lie within 9e18"};
    }
    values[i] = *value;
  }
  if (values[2] < 0) {
    return Error{"ticks_100ns must not be negative"};
  }
  const FrameRow row{values[0], Timestamp(Duration(values[1])), values[2],
                     Timestamp(Duration(values[3]))};
  if (!rows.empty() && (row.sequence <= rows.back().sequence || row.time <= rows.back().time ||
                        row.ticks <= rows.back().ticks || row.clock < rows.back().clock)) {
    return Error{"does not come after the line above it"};
  }
  rows.push_back(row);
  return {};
}

Status take_device(std::string_view line, RecordedDevice& device) {
  std::vector<std::string_view> fields;
  split(line, fields);
  const auto value = fields.size() == 2 ? parse_integer(fields[1]) : std::nullopt;
  if (!value) {
    return Error{"must be a key and a whole number"};
  }
  if (*value < -kMaxNs || *value > kMaxNs) {
    return Error{"value must lie within 9e18"};
  }
  if (fields[0] == "epoch_ticks_100ns") {
    device.epoch_ticks_100ns = *value;
  } else if (fields[0] == "display_latency_ns") {
    constexpr std::int64_t kMaxLatencyNs = 10'000'000'000;
    if (*value < 0 || *value > kMaxLatencyNs) {
      return Error{"display_latency_ns must lie in [0, 10000000000]"};
    }
    device.display_latency = Duration(*value);
  } else if (fields[0] == "clock_start_ns") {
    device.clock_start = Timestamp(Duration(*value));
  } else if (fields[0] == "stamps_late_ns") {
    constexpr std::int64_t kMaxLateNs = 100'000'000;
    if (*value < 0 || *value > kMaxLateNs) {
      return Error{"stamps_late_ns must lie in [0, 100000000]"};
    }
    device.stamps_late = Duration(*value);
  } else if (fields[0] == "pictures_may_repeat" || fields[0] == "head_pose_may_repeat") {
    if (*value != 0 && *value != 1) {
      return Error{std::string(fields[0]) + " must be 0 or 1"};
    }
    MayRepeat& may = device.may_repeat;
    (fields[0].front() == 'p' ? may.pictures : may.head_pose) = *value == 1;
  } else {
    return Error{
        "key is unknown; known are epoch_ticks_100ns, display_latency_ns, clock_start_ns, "
        "stamps_late_ns, pictures_may_repeat and head_pose_may_repeat"};
  }
  return {};
}

}  // namespace

Result<PosesByTicks> read_poses(const std::filesystem::path& path) {
  const auto text = read_text(path, kMaxPosesBytes);
  if (!text) {
    return text.error();
  }
  PosesByTicks poses;
  std::vector<std::string_view> fields;
  Status status =
      for_each_whole_line(*text, [&](std::size_t number, std::string_view line) -> Status {
        if (Status taken = take_pose(line, fields, poses); !taken) {
          return line_error(path, number, taken.error().message);
        }
        return {};
      });
  if (!status) {
    return status.error();
  }
  return poses;
}

void append_pose(std::string& line, std::int64_t ticks, const Transform<World, Rig>& pose) {
  append_number(line, ticks);
  for (const double entry : pose.row_major()) {
    line += ',';
    append_number(line, entry);
  }
}

Result<std::vector<FrameRow>> read_frames(const std::filesystem::path& path) {
  std::vector<FrameRow> rows;
  std::vector<std::string_view> fields;
  Status status =
      for_each_grown_row(path, kMaxFramesBytes, kFramesHeader,
                         [&](std::string_view line) { return take_frame(line, fields, rows); });
  if (!status) {
    return status.error();
  }
  return rows;
}

void append_frame(std::string& line, const FrameRow& row) {
  append_number(line, row.sequence);
  line += ',';
  append_number(line, std::int64_t{row.time.time_since_epoch().count()});
  line += ',';
  append_number(line, row.ticks);
  line += ',';
  append_number(line, std::int64_t{row.clock.time_since_epoch().count()});
}

Result<std::vector<MapRow>> read_map_moves(const std::filesystem::path& path) {
  std::vector<MapRow> rows;
  std::vector<std::string_view> fields;
  Status status =
      for_each_grown_row(path, kMaxFramesBytes, kMapHeader, [&](std::string_view line) -> Status {
        split(line, fields);
        const auto sequence = parse_integer(fields[0]);
        const auto epoch = fields.size() == 2 ? parse_integer(fields[1]) : std::nullopt;
        if (!sequence || !epoch) {
          return Error{"must be two whole numbers"};
        }
        const bool follows =
            rows.empty() || (*sequence > rows.back().sequence && *epoch > rows.back().map_epoch);
        if (!follows) {
          return Error{"does not come after the line above it"};
        }
        rows.push_back({*sequence, *epoch});
        return {};
      });
  if (!status) {
    return status.error();
  }
  return rows;
}

void append_map_move(std::string& line, const MapRow& row) {
  append_number(line, row.sequence);
  line += ',';
  append_number(line, row.map_epoch);
}

Result<RecordedDevice> read_device(const std::filesystem::path& path) {
  RecordedDevice device;
  Status status = for_each_row(path, kMaxDeviceBytes, kDeviceHeader,
                               [&](std::string_view line) { return take_device(line, device); });
  if (!status) {
    return status.error();
  }
  return device;
}

std::string device_text(const RecordedDevice& device) {
  std::string text = std::string(kDeviceHeader) + "\nepoch_ticks_100ns,";
  append_number(text, device.epoch_ticks_100ns.value_or(0));
  text += "\ndisplay_latency_ns,";
  append_number(text, std::int64_t{device.display_latency.count()});
  if (device.clock_start) {
    text += "\nclock_start_ns,";
    append_number(text, std::int64_t{device.clock_start->time_since_epoch().count()});
  }
  if (device.may_repeat.pictures) {
    text += "\npictures_may_repeat,1";
  }
  if (device.may_repeat.head_pose) {
    text += "\nhead_pose_may_repeat,1";
  }
  return text + "\n";
}

std::int64_t epoch_of(std::int64_t first_ticks) {
  return first_ticks > kMaxTicks ? kUnixEpochTicks : 0;
}

std::optional<Timestamp> device_time(std::int64_t ticks, std::int64_t epoch_ticks) {
  // The epoch comes from a file and may be any number, so compare before subtracting. Two
  // non-negative numbers can't overflow; with a negative epoch, both terms of the sum are within
  // 9e18.
  if (ticks < 0 || epoch_ticks < -kMaxNs) {
    return std::nullopt;
  }
  const bool fits = epoch_ticks >= 0
                        ? ticks - epoch_ticks <= kMaxTicks && ticks - epoch_ticks >= -kMaxTicks
                        : ticks <= kMaxTicks + epoch_ticks;
  if (!fits) {
    return std::nullopt;
  }
  return from_ticks_100ns(ticks - epoch_ticks);
}

Result<Timestamp> named_time(const std::filesystem::path& path, std::int64_t ticks,
                             std::int64_t epoch_ticks) {
  const auto time = device_time(ticks, epoch_ticks);
  if (time) {
    return *time;
  }
  return file_error(path, "time " + std::to_string(ticks) +
                              " lies more than 285 years from the recording's epoch " +
                              std::to_string(epoch_ticks));
}

Status check_row(const std::filesystem::path& path, const FrameRow& row, std::int64_t epoch_ticks) {
  const auto by_ticks = device_time(row.ticks, epoch_ticks);
  if (by_ticks && *by_ticks <= row.time && row.time < *by_ticks + Duration(100)) {
    return {};
  }
  return file_error(path, "sequence " + std::to_string(row.sequence) +
                              ": time_ns does not belong to its ticks_100ns");
}

}  // namespace orthonav::replay
