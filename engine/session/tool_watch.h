#pragma once

#include <optional>

#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// The recent past of one tool: its two newest measured poses, from which it is predicted, and the
/// newest state, measured or not.
class ToolWatch {
 public:
  void update(const nav::TrackedPose& world_from_marker);
  [[nodiscard]] const nav::TrackedPose& newest() const { return newest_; }
  [[nodiscard]] bool measured_now() const { return newest_.status == PoseStatus::kMeasured; }
  [[nodiscard]] std::optional<Timestamp> last_measured() const;
  /// Whether it was measured no longer than `within` before `now`.
  [[nodiscard]] bool fresh(Timestamp now, Duration within) const;
  /// The newest measured pose; lost if there was none.
  [[nodiscard]] const nav::TrackedPose& last_measured_pose() const { return newer_; }
  /// Where the tool will be at `time`; lost if no measured pose is near enough in time.
  [[nodiscard]] nav::TrackedPose at(Timestamp time, Duration coast) const;

 private:
  nav::TrackedPose newest_;
  nav::TrackedPose newer_;  ///< newest measured
  nav::TrackedPose older_;  ///< measured before that
};

}  // namespace orthonav::engine
