#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "hal/api/forwarding_headset.h"

namespace orthonav::replay {

struct RecorderOptions {
  std::string tools_json;  ///< kept beside the recording as tools.json, if not empty
  /// The recorder itself reads the depth cameras whenever it is asked for a pair, and hides them
  /// from the session: for a session that does not use depth. False: only frames that the session
  /// reads are recorded.
  bool takes_depth = false;
};

/// What came to a recording.
struct RecordedCounts {
  std::int64_t pairs = 0;       ///< that the cameras delivered
  std::int64_t lost_pairs = 0;  ///< of these, not recorded since the disk was too slow
  std::int64_t lost_others =
      0;  ///< depth pictures, answers of the head tracker and events likewise
};

/// A headset that forwards everything to another one and records it: images, depth, head poses,
/// answers of the head tracker, clicker and voice. It writes StreamRecorder's layout and a few more
/// files (docs/recordings.md). Where every pair is taken (a simulation, a replay), ReplayHeadset
/// delivers the same session to the bit. From a device that receives pairs on its own
/// (`StereoCamera::tap`), all of them are recorded, also those that the session asked for too late.
///
/// Writes into `folder` + ".part" and renames on close(); an interrupted recording stays there. A
/// thread of its own writes, and a recording never disturbs the session: everything is passed on
/// unchanged. On a disk that is too slow at most 96 MiB wait; beyond that pairs are lost and
/// counted. Where time stands still until the next pair is asked for, `next` waits for the disk and
/// nothing is lost. If the disk fails (it is full), recording stops, and recording_status() and
/// close() say why.
class RecordingHeadset : public ForwardingHeadset {
 public:
  /// Refuses a folder that exists and is not empty, one left over under the temporary name, and
  /// cameras that are not 640×480.
  static Result<std::unique_ptr<RecordingHeadset>> create(std::unique_ptr<Headset> inner,
                                                          const std::filesystem::path& folder,
                                                          const RecorderOptions& options = {});
  /// The same around a borrowed headset.
  static Result<std::unique_ptr<RecordingHeadset>> around(Headset& inner,
                                                          const std::filesystem::path& folder,
                                                          const RecorderOptions& options = {});
  /// The first failure of the recording so far.
  [[nodiscard]] virtual Status recording_status() const = 0;
  /// Whether it failed: callable at every step from any thread, never waits.
  [[nodiscard]] virtual bool recording_failed() const = 0;
  /// Callable like recording_failed().
  [[nodiscard]] virtual RecordedCounts counts() const = 0;
  /// Records nothing that comes from now on; does not wait.
  virtual void stop() = 0;
  /// Waits for what is still to be written, finishes the files and gives the folder its name.
  /// Nothing is recorded after that, but the devices continue. A recording without a single pair is
  /// an error. The destructor closes too, but can't report whether that succeeded.
  virtual Status close() = 0;

 protected:
  explicit RecordingHeadset(Headset& inner) : ForwardingHeadset(inner) {}
};

}  // namespace orthonav::replay
