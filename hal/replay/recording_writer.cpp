#include "hal/replay/recording_writer.h"

#include <system_error>

#include "base/file_code.h"
#include "hal/replay/calibration_files.h"
#include "hal/replay/durable.h"
#include "hal/replay/frame_files.h"
#include "hal/replay/layout.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

Status check_free(const std::filesystem::path& folder, const std::filesystem::path& part) {
  std::error_code code;
  if (std::filesystem::exists(part, code)) {
    return file_error(
        part, "was left by a recording that was cut off; orthonav recording repair closes it");
  }
  if (!std::filesystem::exists(folder, code)) {
    return {};
  }
  if (!std::filesystem::is_directory(folder, code) || !std::filesystem::is_empty(folder, code)) {
    return file_error(folder, "exists already; a recording needs a new or empty folder");
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(
    const std::filesystem::path& folder, const StereoCalibration& calibration,
    const RecordedDevice& device, const std::string& tools_json) {
  auto writer = std::make_unique<RecordingWriter>();
  // The temporary folder lies next to it.
  writer->folder_ = without_slash(folder);
  if (writer->folder_.empty()) {
    return file_error(folder, "is not a name for a recording");
  }
  writer->part_ = writer->folder_;
  writer->part_ += kUnfinished;
  writer->epoch_ticks_ = device.epoch_ticks_100ns.value_or(0);
  if (Status s = check_free(writer->folder_, writer->part_); !s) {
    return s.error();
  }
  std::error_code code;
  std::filesystem::create_directories(writer->part_, code);
  if (code) {
    return file_error(writer->part_, "cannot be made: " + code.message(), file_code(code));
  }
  const auto filled = [&]() -> Status {
    if (Status s = write_calibration(writer->part_, calibration); !s) {
      return s;
    }
    if (Status s = write_bytes(writer->part_ / kDeviceFile, device_text(device)); !s) {
      return s;
    }
    if (!tools_json.empty()) {
      if (Status s = write_bytes(writer->part_ / kToolsFile, tools_json); !s) {
        return s;
      }
    }
    return writer->open_files();
  }();
  if (!filled) {
    std::filesystem::remove_all(writer->part_, code);  // nothing was recorded in it yet
    return filled.error();
  }
  return writer;
}

Status RecordingWriter::open_files() {
  if (Status s = left_.open(tar_of(part_, kLeftSensor)); !s) {
    return s;
  }
  if (Status s = right_.open(tar_of(part_, kRightSensor)); !s) {
    return s;
  }
  if (Status s = frames_.open(part_ / kFramesFile, part_ / kMapFile,
                              {poses_of(part_, kLeftSensor), poses_of(part_, kRightSensor)});
      !s) {
    return s;
  }
  if (Status s = events_.open(part_ / kEventsFile, kEventsHeader); !s) {
    return s;
  }
  return head_.open(part_ / kHeadFile, kHeadHeader);
}

Status RecordingWriter::frame(const StereoFrame& frame, Timestamp clock) {
  const std::int64_t ticks = epoch_ticks_ + ticks_100ns(frame.time);
  if (Status s = frames_.check(ticks); !s) {
    return file_error(part_, "pairs: " + s.error().message);
  }
  if (Status s = left_.write(ticks, frame.left); !s) {
    return s;
  }
  if (Status s = right_.write(ticks, frame.right); !s) {
    return s;
  }
  const FrameRow row{frame.sequence, frame.time, ticks, clock};
  if (Status s = frames_.write(row, frame.map_epoch, frame.world_from_rig); !s) {
    return s;
  }
  ++pairs_;
  return {};
}

Status RecordingWriter::depth(const DepthCalibration& calibration, const DepthFrame& frame,
                              Timestamp clock) {
  const auto [writer, added] = depths_.try_emplace(calibration.stream);
  if (added) {
    if (Status s = writer->second.open(part_, calibration); !s) {
      return s;
    }
  }
  return writer->second.write(frame, epoch_ticks_ + ticks_100ns(frame.time), clock);
}

Status RecordingWriter::event(const Delivered<ClickerEvent>& event) {
  std::string line;
  append_event(line, event);
  return events_.write(line);
}

Status RecordingWriter::event(const Delivered<Phrase>& event) {
  std::string line;
  append_event(line, event);
  return events_.write(line);
}

Status RecordingWriter::head_answer(std::int64_t sequence,
                                    const Tracked<Transform<World, Rig>>& answer) {
  std::string line;
  append_head_answer(line, sequence, answer);
  return head_.write(line);
}

Status RecordingWriter::close() {
  if (Status s = left_.close(); !s) {
    return s;
  }
  if (Status s = right_.close(); !s) {
    return s;
  }
  if (Status s = frames_.close(); !s) {
    return s;
  }
  for (auto& [stream, depth] : depths_) {
    if (Status s = depth.close(); !s) {
      return s;
    }
  }
  for (LineFile* file : {&events_, &head_}) {
    if (Status s = file->close(); !s) {
      return s;
    }
  }
  std::error_code code;
  if (pairs_ == 0) {
    std::filesystem::remove_all(part_, code);
    return file_error(folder_, "no pair came: nothing was recorded");
  }
  return rename_durably(part_, folder_);
}

}  // namespace orthonav::replay
