#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "hal/api/tool_pose_source.h"
#include "hal/igtl/pose_message.h"

namespace orthonav::igtl {

/// What the name of a transform says: `AToB` is the pose of A in B.
struct NamedFrames {
  std::string of;
  std::string in;
};
/// Absent if the name holds no "To". Capitals decide where it is: "ToolToTracker" has one, and so
/// has "tooltotracker" for lack of any. An Error if several are possible.
Result<std::optional<NamedFrames>> frames_named(const std::string& transform);

/// A tool and the name of the transform that another program sends for it.
struct NamedTransform {
  std::string tool;
  std::string transform;
};

struct PoseFramesOptions {
  std::vector<NamedTransform> tools;
  PoseCovariance covariance{};  ///< as stated for every tool
  /// A pose that is identical to the last bit for longer than this counts as lost, since it is
  /// evidently not being measured any more. Zero: not checked.
  Duration frozen_after = std::chrono::seconds(1);
};

/// Groups poses that arrive one by one into frames, each of one moment.
class PoseFrames {
 public:
  /// Poses stamped no further apart than this belong to one moment: half a millimetre at 250 mm/s.
  static constexpr Duration kOneMoment = std::chrono::milliseconds(2);
  /// A tool not heard for longer than this may be sent in another frame instead.
  static constexpr Duration kSentOtherwise = std::chrono::seconds(1);
  /// How long a frame waits for tools that may be out of sight.
  static constexpr Duration kWaitForRest = std::chrono::milliseconds(10);
  /// After this long without a pose no tool is in sight, which is reported by frames in which all
  /// are lost.
  static constexpr Duration kNobodyInSight = std::chrono::milliseconds(100);

  explicit PoseFrames(PoseFramesOptions options);

  /// Takes a pose stamped at `time`, which must not be later than `now`.
  void take(const SentPose& pose, Timestamp time, Timestamp now);
  /// The newest frame that is complete by `now` and was not handed out yet. A frame is complete
  /// when all tools are in it, a later moment has begun, or it has waited long enough. Times
  /// strictly increase.
  [[nodiscard]] std::optional<ToolPoses> next(Timestamp now);
  /// The name of a transform that is a tool's pose in another frame than asked for, where that tool
  /// is not sent otherwise: each tool once, until `forget`.
  [[nodiscard]] std::optional<std::string> take_complaint();
  /// The connection is new: an incomplete frame is dropped.
  void forget();

  [[nodiscard]] std::int64_t out_of_order() const { return out_of_order_; }
  /// Names of received transforms that belong to no tool; the first few, each once.
  [[nodiscard]] const std::vector<std::string>& others() const { return others_; }
  /// Number of tools with a pose so far.
  [[nodiscard]] std::size_t heard() const;

 private:
  /// The last pose of a tool.
  struct Told {
    bool ever = false;
    bool now = false;  ///< in the frame being assembled
    std::optional<Transform<World, Marker>> pose;
    Timestamp since{};  ///< when this identical pose first arrived
    std::string of;     ///< as its transform's name says; empty: it does not
    std::optional<Timestamp> heard_at;
    bool complained = false;
  };
  [[nodiscard]] std::optional<std::size_t> tool_of(const std::string& transform);
  void look_for_tool_elsewhere(const std::string& transform, Timestamp now);
  void close();
  /// All tools lost.
  [[nodiscard]] ToolPoses empty_frame(Timestamp time) const;
  void note(std::size_t tool, const SentPose& pose, Timestamp time);

  PoseFramesOptions options_;
  std::vector<Told> told_;
  std::optional<Timestamp> open_;  ///< the moment being assembled
  Timestamp opened_at_{};
  std::optional<ToolPoses> done_;
  std::optional<Timestamp> last_;  ///< of the newest complete frame
  Timestamp heard_at_{};
  std::int64_t out_of_order_ = 0;
  std::vector<std::string> others_;
  std::optional<Timestamp> begun_;  ///< when this connection's first pose came
  std::optional<std::string> complaint_;
};

}  // namespace orthonav::igtl
