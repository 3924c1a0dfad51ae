#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "hal/replay/depth_files.h"
#include "hal/replay/event_files.h"
#include "hal/replay/head_history.h"
#include "hal/replay/image_tar.h"
#include "hal/replay/replay_headset.h"

namespace orthonav::replay {

/// One pair to be delivered.
struct RecordedPair {
  std::int64_t sequence = 0;
  Timestamp time{};
  Timestamp clock{};  ///< the device's clock when the pair was available
  ImageMember left;
  ImageMember right;
  std::optional<Transform<World, Rig>> world_from_rig;
  std::int64_t map_epoch = 0;
};

/// The content of device.csv; the defaults are those of a recording without it.
struct RecordedDevice {
  std::optional<std::int64_t> epoch_ticks_100ns;
  Duration display_latency{};
  std::optional<Timestamp> clock_start;
  std::optional<Duration> stamps_late;  ///< in files from another recorder
  MayRepeat may_repeat;
};

/// A checked folder, without the pixels.
struct Recording {
  StereoCalibration calibration;
  ImageTar left;
  ImageTar right;
  std::vector<RecordedPair> pairs;
  HeadHistory head;
  /// When each map begins that the recording itself does not tell of.
  std::vector<Timestamp> jumps;
  HeadAnswers head_answers;
  RecordedEvents events;
  std::int64_t epoch_ticks_100ns = 0;
  Duration stamps_late{};  ///< of the front cameras' files; corrected everywhere else
  Timestamp clock_start{};
  Duration display_latency{};
  MayRepeat may_repeat;
  std::string tools_json;
  std::vector<RecordedDepth> depth;
  RecordingSummary summary;
};

Result<Recording> read_recording(const std::filesystem::path& folder,
                                 RecordedStamps stamps = RecordedStamps::kByRecorder);

}  // namespace orthonav::replay
