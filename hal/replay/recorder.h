#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "hal/api/forwarding_headset.h"

namespace orthonav::replay {

struct RecorderOptions {
  std::string tools_json;  ///< kept beside the recording as tools.json, if not empty
  /// The depth cameras are read by the recorder itself, whenever it is asked for a pair, and nobody
  /// else sees them: for a session that has no use for depth. False: what somebody reads is
  /// recorded.
  bool takes_depth = false;
};

/// A headset that passes everything on to another one and records what went through: images, depth,
/// head poses, answers of the head tracker, clicker and voice. It writes StreamRecorder's layout
/// and a few files more (docs/recordings.md), so that ReplayHeadset delivers the same session to
/// the bit.
///
/// Writes into `folder` + ".part" and renames on close(); a recording that was cut off stays there.
/// A recording that fails (a full disk) never disturbs the session: everything is passed on
/// unchanged, recording stops, and recording_status() and close() say why. Each call writes on the
/// thread that makes it; cameras, depth cameras and close() belong to one.
class RecordingHeadset : public ForwardingHeadset {
 public:
  /// Refuses a folder that exists and is not empty, one left over under the temporary name, and
  /// cameras that are not 640×480.
  static Result<std::unique_ptr<RecordingHeadset>> create(std::unique_ptr<Headset> inner,
                                                          const std::filesystem::path& folder,
                                                          const RecorderOptions& options = {});
  /// The same around a headset that somebody else owns and keeps alive.
  static Result<std::unique_ptr<RecordingHeadset>> around(Headset& inner,
                                                          const std::filesystem::path& folder,
                                                          const RecorderOptions& options = {});
  /// The first failure of the recording so far.
  [[nodiscard]] virtual Status recording_status() const = 0;
  /// Whether it failed, for whoever asks in each step, on any thread: waits for nobody.
  [[nodiscard]] virtual bool recording_failed() const = 0;
  /// Finishes the files and gives the folder its name. Nothing is recorded from here on, while the
  /// devices go on. A recording without a single pair is no recording: an error. The destructor
  /// closes too, but cannot say whether that went well.
  virtual Status close() = 0;

 protected:
  explicit RecordingHeadset(Headset& inner) : ForwardingHeadset(inner) {}
};

}  // namespace orthonav::replay
