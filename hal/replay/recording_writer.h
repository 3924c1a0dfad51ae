#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "hal/api/devices.h"
#include "hal/replay/depth_writer.h"
#include "hal/replay/event_files.h"
#include "hal/replay/growing_files.h"
#include "hal/replay/recording.h"

namespace orthonav::replay {

/// Writes a recording's folder; the counterpart of read_recording. frame(), depth() and close()
/// belong to one thread, the others to any.
class RecordingWriter {
 public:
  static Result<std::unique_ptr<RecordingWriter>> create(const std::filesystem::path& folder,
                                                         const StereoCalibration& calibration,
                                                         const RecordedDevice& device,
                                                         const std::string& tools_json);
  Status frame(const StereoFrame& frame, Timestamp clock);
  /// A frame of one of the depth cameras, each of which has its own file from its first frame on.
  Status depth(const DepthCalibration& calibration, const DepthFrame& frame, Timestamp clock);
  Status event(const Delivered<ClickerEvent>& event);
  Status event(const Delivered<Phrase>& event);
  Status head_answer(std::int64_t sequence, const Tracked<Transform<World, Rig>>& answer);
  /// Finishes every file and renames the folder.
  Status close();

 private:
  std::filesystem::path folder_;
  std::filesystem::path part_;
  std::int64_t epoch_ticks_ = 0;
  std::int64_t pairs_ = 0;
  ImageTarWriter left_;
  ImageTarWriter right_;
  FrameListWriter frames_;
  std::map<DepthStream, DepthWriter> depths_;
  LineFile events_;
  LineFile head_;

  Status open_files();
};

}  // namespace orthonav::replay
