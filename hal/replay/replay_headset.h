#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/api/depth_camera.h"
#include "hal/api/devices.h"
#include "hal/api/research_mode.h"

namespace orthonav::replay {

/// What a recording holds of one depth stream, and what of it could not be delivered.
struct DepthSummary {
  DepthStream stream = DepthStream::kLongThrow;
  int width_px = 0;
  int height_px = 0;
  std::int64_t frames = 0;
  std::int64_t frames_without_pose = 0;
  std::int64_t brightness_unpaired = 0;  ///< brightness images without a frame of their time
  std::int64_t repeated = 0;             ///< images of a time that the camera had already
  std::int64_t first_ticks_100ns = 0;    ///< as the files name the first and the last frame
  std::int64_t last_ticks_100ns = 0;
  std::string cut;      ///< in one line, where it was cut off; empty: it was not
  std::string trouble;  ///< in one line, why the stream cannot be read; empty: it can
};

/// What a recording holds and what of it could not be delivered.
struct RecordingSummary {
  std::int64_t pairs = 0;
  std::int64_t first_ticks_100ns = 0;  ///< as the files name the first and the last pair
  std::int64_t last_ticks_100ns = 0;
  std::int64_t left_unpaired = 0;   ///< left images without a right one within kPairWithin
  std::int64_t right_unpaired = 0;  ///< and the other way round
  std::int64_t repeated = 0;        ///< images of a time that its camera had already
  std::int64_t pairs_without_pose = 0;
  std::string cut;                  ///< in one line, where it was cut off; empty: it was finished
  std::vector<DepthSummary> depth;  ///< of each stream; one in trouble is not among the cameras
};

/// What a user should read of a recording that was cut off, in one line; empty for any other.
[[nodiscard]] std::string cut_warning(const RecordingSummary& summary);

/// Two images belong together when each is the other's nearest, within this: stamps tremble by 2 ms
/// and more, and from another moment an image is a whole frame away.
inline constexpr Duration kPairWithin = kGreyCameraInterval / 3;

/// How a recording stamps its images.
enum class RecordedStamps {
  /// StreamRecorder's are late by kResearchModeStampsLate, unless a device.csv beside them says
  /// otherwise (`stamps_late_ns`): times and poses are corrected. Others' are not.
  kByRecorder,
  kExact  ///< as the images were taken, whoever recorded them
};

/// How fast a recording goes by.
enum class ReplayPace {
  kFast,      ///< a pair at each call of cameras().next(); the clock is the time of the last one.
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
/// comes back to the bit; which of them it is, its files tell.
///
/// Depth streams are its depth cameras. One that is damaged is left out, and the summary says why:
/// pairs alone make a session. One that was cut off is read to its last whole pair, and the summary
/// says where. The time of a pair is its left image's. The head is known up to the
/// last frame, predicted beyond it, lost where two recorded poses lie more than
/// HeadTracker::kMaxHeadPrediction apart. The tools are described by the text of its tools.json,
/// where it has one. The display shows nothing; its latency is the recorded one.
class ReplayHeadset : public Headset {
 public:
  /// Refuses, in one line that names file, field, value and limit, whatever is missing, not finite,
  /// mirrored or of the wrong size; images themselves are read when they are due.
  static Result<std::unique_ptr<ReplayHeadset>> open(const std::filesystem::path& folder,
                                                     const ReplayOptions& options = {});
  /// Lets one more pair through, where the pace is kStepped. Thread-safe.
  virtual void step() = 0;
  [[nodiscard]] virtual const RecordingSummary& summary() const = 0;
};

}  // namespace orthonav::replay
