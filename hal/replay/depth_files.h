#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/api/depth_camera.h"
#include "hal/replay/image_tar.h"
#include "hal/replay/replay_headset.h"

namespace orthonav::replay {

/// One picture to be delivered.
struct RecordedDepthFrame {
  std::int64_t sequence = 0;
  Timestamp time{};
  Timestamp clock{};  ///< the device's clock when it was available
  ImageMember range;
  std::optional<ImageMember> brightness;
  std::optional<Transform<World, Rig>> world_from_rig;
  std::int64_t map_epoch = 0;
};

/// One checked depth stream of a folder, without its pixels.
struct RecordedDepth {
  DepthCalibration calibration;
  ImageTar images;
  std::vector<RecordedDepthFrame> frames;  ///< at least one
  std::uint16_t invalid_from_mm = 0;       ///< ranges from this on are not measurements; 0: all are
  DepthSummary summary;

  /// Reads the pixels; the buffers of `frame` are reused.
  Status read(const RecordedDepthFrame& recorded, DepthFrame& frame);
};

struct RecordedDepths {
  std::vector<RecordedDepth> streams;
  std::vector<DepthSummary> unreadable;  ///< each with the reason
};

/// The depth streams of a folder from any of the recorders. They need no stereo pairs.
/// `epoch_ticks`: the ticks of the recording's time zero; absent: as stated in the folder.
RecordedDepths read_depths(const std::filesystem::path& folder,
                           std::optional<std::int64_t> epoch_ticks = std::nullopt);

}  // namespace orthonav::replay
