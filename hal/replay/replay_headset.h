#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/api/depth_camera.h"
#include "hal/api/devices.h"
#include "hal/api/headset_scheme.h"
#include "hal/api/research_mode.h"

namespace orthonav::replay {

/// The content of one depth stream of a recording, and what could not be delivered.
struct DepthSummary {
  DepthStream stream = DepthStream::kLongThrow;
  int width_px = 0;
  int height_px = 0;
  std::int64_t frames = 0;
  std::int64_t frames_without_pose = 0;
  std::int64_t brightness_unpaired = 0;  ///< brightness images without a frame at their time
  std::int64_t repeated = 0;             ///< images with a repeated time
  std::int64_t first_ticks_100ns = 0;    ///< of the first and the last frame, as in the files
  std::int64_t last_ticks_100ns = 0;
  std::string cut;      ///< in one line, where it was truncated; empty: it was not
  std::string trouble;  ///< in one line, why the stream can't be read; empty: it can
};

/// The content of a recording, and what could not be delivered.
struct RecordingSummary {
  std::int64_t pairs = 0;
  std::int64_t first_ticks_100ns = 0;  ///< of the first and the last pair, as in the files
  std::int64_t last_ticks_100ns = 0;
  std::int64_t left_unpaired = 0;   ///< left images without a right one within kPairWithin
  std::int64_t right_unpaired = 0;  ///< the same for right images
  std::int64_t repeated = 0;        ///< images with a repeated time of their camera
  std::int64_t pairs_without_pose = 0;
  std::int64_t missing = 0;         ///< pairs by their numbers: lost, or not taken in time
  std::int64_t map_jumps = 0;       ///< found in the poses, without those that it tells of
  std::string cut;                  ///< in one line, where it was truncated; empty: it was finished
  std::vector<DepthSummary> depth;  ///< of each stream; an unreadable one is not among the cameras
};

/// The warning for a truncated recording, in one line; empty for any other.
[[nodiscard]] std::string cut_warning(const RecordingSummary& summary);

/// Two images form a pair if each is the other's nearest, within this time: stamps jitter by 2 ms
/// and more, and images of different moments are a whole frame apart.
inline constexpr Duration kPairWithin = kGreyCameraInterval / 3;

/// How a recording stamps its images.
enum class RecordedStamps {
  /// StreamRecorder's stamps are late by kResearchModeStampsLate, unless a device.csv in the folder
  /// says otherwise (`stamps_late_ns`): times and poses are corrected. Stamps of other recorders
  /// are not late.
  kByRecorder,
  kExact  ///< taken as correct for any recorder
};

/// How fast a recording is replayed.
enum class ReplayPace {
  kFast,      ///< a pair at each call of cameras()->next(); the clock is the time of the last one.
              ///< Depth comes when a pair has brought the clock that far; once the pairs have
              ///< ended, the depth that is left brings the clock on
  kRealtime,  ///< the clock goes on as the wall's; who asks late misses pairs, as with a camera
  kStepped    ///< a pair after each `step()`, else the clock stands still; depth as with kFast
};

struct ReplayOptions {
  ReplayPace pace = ReplayPace::kFast;
  const Clock* wall = nullptr;  ///< of kRealtime, borrowed; null: the machine's steady clock
  RecordedStamps stamps = RecordedStamps::kByRecorder;
};

/// A recorded session as a headset. Reads the folders of HoloLens 2's StreamRecorder, of HoloLens
/// 1's HoloLensForCV, and those of our own recorder, which holds more (docs/recordings.md) and
/// comes back to the bit; the files show which one it is.
///
/// Depth streams are its depth cameras. A damaged one is left out, and the summary says why: a
/// session needs only pairs. A truncated one is read up to its last whole pair, and the summary
/// says where. The time of a pair is its left image's. Where the poses jump as no head moves, a new
/// map begins, as with a live headset, besides those that the recording tells of. The head is known
/// up to the last frame, predicted beyond it, lost where two recorded poses lie more than
/// HeadTracker::kMaxHeadPrediction apart. The tools are described by the text of its tools.json, if
/// there is one. The display shows nothing; its latency is the recorded one.
class ReplayHeadset : public Headset {
 public:
  /// Refuses, in one line that names file, field, value and limit, anything missing, not finite,
  /// mirrored or of the wrong size; images themselves are read when they are due.
  static Result<std::unique_ptr<ReplayHeadset>> open(const std::filesystem::path& folder,
                                                     const ReplayOptions& options = {});
  /// Lets one more pair through if the pace is kStepped. Thread-safe.
  virtual void step() = 0;
  [[nodiscard]] virtual const RecordingSummary& summary() const = 0;
};

/// `replay:PATH[?pace=fast|realtime|step&stamps=recorder|exact]`.
[[nodiscard]] HeadsetScheme scheme();

}  // namespace orthonav::replay
