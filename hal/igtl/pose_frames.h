#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "hal/api/measured_tool.h"
#include "hal/igtl/pose_message.h"

namespace orthonav::igtl {

/// A tool and the transform that another program sends of it.
struct NamedTransform {
  std::string tool;
  std::string transform;
};

/// Tools of one moment.
struct PoseFrame {
  Timestamp time{};
  std::vector<MeasuredTool> tools;
};

struct PoseFramesOptions {
  std::vector<NamedTransform> tools;
  PoseCovariance covariance{};  ///< as stated for every tool
  /// A pose that stays the same to the last bit for longer counts as lost: nobody measures it any
  /// more. Zero: not checked.
  Duration frozen_after = std::chrono::seconds(1);
};

/// Groups poses that come one by one into frames, each of one moment.
class PoseFrames {
 public:
  /// Poses that are stamped no further apart are of one moment: at 250 mm/s half a millimetre.
  static constexpr Duration kOneMoment = std::chrono::milliseconds(2);
  /// How long a frame waits for tools, which may be out of sight.
  static constexpr Duration kWaitForRest = std::chrono::milliseconds(10);
  /// After so long without a pose no tool is in sight: frames without tools say so.
  static constexpr Duration kNobodyInSight = std::chrono::milliseconds(100);

  explicit PoseFrames(PoseFramesOptions options);

  /// A pose stamped at `time`, which is not past `now`.
  void take(const SentPose& pose, Timestamp time, Timestamp now);
  /// The newest frame that is complete by `now` and was not handed out yet: all tools are told, a
  /// later moment has begun, or it has waited long enough. Times strictly increase.
  [[nodiscard]] std::optional<PoseFrame> next(Timestamp now);
  /// The connection is new: what was begun is not completed any more.
  void forget();

  [[nodiscard]] std::int64_t out_of_order() const { return out_of_order_; }
  [[nodiscard]] std::int64_t replaced() const { return replaced_; }
  /// Transforms that were sent and are no tool's; the first few, each once.
  [[nodiscard]] const std::vector<std::string>& others() const { return others_; }
  /// Tools of which a pose came.
  [[nodiscard]] std::size_t heard() const;

 private:
  /// What was last told of a tool.
  struct Told {
    bool ever = false;
    bool now = false;  ///< in the frame that is being put together
    std::optional<Transform<Rig, Marker>> pose;
    Timestamp since{};  ///< when it came first, the same to the bit
  };
  [[nodiscard]] std::optional<std::size_t> tool_of(const std::string& transform);
  void close();
  void note(std::size_t tool, const SentPose& pose, Timestamp time);

  PoseFramesOptions options_;
  std::vector<Told> told_;
  std::optional<Timestamp> open_;  ///< the moment that is being put together
  Timestamp opened_at_{};
  std::optional<PoseFrame> done_;
  std::optional<Timestamp> last_;  ///< of the newest frame that is complete
  Timestamp heard_at_{};
  std::int64_t out_of_order_ = 0;
  std::int64_t replaced_ = 0;
  std::vector<std::string> others_;
};

}  // namespace orthonav::igtl
