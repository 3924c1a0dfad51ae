#include "hal/replay/depth_writer.h"

#include <string>

#include "hal/replay/calibration_files.h"
#include "hal/replay/layout.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

const char* sensor_of(DepthStream stream) {
  switch (stream) {
    case DepthStream::kAhat:
      return kAhatSensor;
    case DepthStream::kLongThrow:
      return kLongThrowSensor;
    case DepthStream::kShortThrow:
      return kShortThrowSensor;
  }
  return kLongThrowSensor;
}

}  // namespace

Status DepthWriter::open(const std::filesystem::path& folder, const DepthCalibration& calibration) {
  const std::string sensor = sensor_of(calibration.stream);
  for (const int side_px : {calibration.width_px, calibration.height_px}) {
    if (side_px < kMinDepthSidePx || side_px > kMaxDepthSidePx) {
      return Error{"recording: " + sensor + " is " + std::to_string(calibration.width_px) + "x" +
                   std::to_string(calibration.height_px) + " px, each side must be " +
                   std::to_string(kMinDepthSidePx) + " to " + std::to_string(kMaxDepthSidePx)};
    }
  }
  tar_path_ = tar_of(folder, sensor);
  if (Status s = write_depth_calibration(folder, sensor, calibration); !s) {
    return s;
  }
  if (Status s = images_.open(tar_path_); !s) {
    return s;
  }
  return frames_.open(frames_of(folder, sensor), map_of(folder, sensor),
                      {poses_of(folder, sensor)});
}

Status DepthWriter::write(const DepthFrame& frame, std::int64_t ticks, Timestamp clock) {
  if (Status s = frames_.check(ticks); !s) {
    return file_error(tar_path_, s.error().message);
  }
  const bool bright = !frame.brightness.pixels.empty();
  if (bright) {
    if (Status s = images_.write(ticks, "_ab", frame.brightness); !s) {
      return s;
    }
  }
  if (Status s = images_.write(ticks, "", frame.range_mm); !s) {
    return s;
  }
  return frames_.write({frame.sequence, frame.time, ticks, clock}, frame.map_epoch,
                       frame.world_from_rig);
}

Status DepthWriter::close() {
  if (Status s = images_.close(); !s) {
    return s;
  }
  return frames_.close();
}

}  // namespace orthonav::replay
