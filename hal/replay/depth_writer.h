#pragma once

#include <cstdint>
#include <filesystem>

#include "hal/api/depth_camera.h"
#include "hal/replay/growing_files.h"

namespace orthonav::replay {

/// Writes one depth stream into a recording's folder; the counterpart of read_depths.
class DepthWriter {
 public:
  /// Refuses a camera that the reader would refuse.
  Status open(const std::filesystem::path& folder, const DepthCalibration& calibration);
  Status write(const DepthFrame& frame, std::int64_t ticks, Timestamp clock);
  Status close();

 private:
  std::filesystem::path tar_path_;
  ImageTarWriter images_;
  FrameListWriter frames_;
};

}  // namespace orthonav::replay
