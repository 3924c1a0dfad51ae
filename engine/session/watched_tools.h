#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/session/guidance.h"
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

/// A clamped patient reference, from its tag down to its foot.
struct ReferencePost {
  Point<World> tag;
  Point<World> foot;
};

/// The tools of an operation, including exactly one pointer and, unless it is of rods alone, one
/// guide, and what the pairs so far have shown of each.
class WatchedTools {
 public:
  /// Refuses tools without a pointer, and without a guide where screws are placed.
  static Result<WatchedTools> create(std::unique_ptr<nav::ToolTracker> tracker,
                                     bool rods_alone = false);

  void track(const StereoFrame& pair) { note(tracker_->track(pair)); }
  void track(const ToolPoses& poses) { note(tracker_->take(poses)); }
  /// Forgets the poses, which are void.
  void forget_poses();
  /// No pair arrives, so no tool is seen.
  void lose_sight();

  [[nodiscard]] std::size_t pointer() const { return pointer_; }
  /// There must be one.
  [[nodiscard]] std::size_t guide() const;
  /// The first patient reference; nothing if there is none.
  [[nodiscard]] std::optional<std::size_t> first_reference() const;
  /// Where the patient references were last measured; those never measured are left out.
  [[nodiscard]] std::vector<ReferencePost> reference_posts() const;
  [[nodiscard]] const ToolWatch& watch(std::size_t tool) const { return watches_[tool]; }
  [[nodiscard]] const nav::ToolGeometry& geometry(std::size_t tool) const {
    return guide_ == tool && corrected_guide_ ? *corrected_guide_ : tracker_->tools()[tool];
  }
  /// Replaces the described tip of the guide until the end of the operation.
  void correct_guide_tip(Point<Marker> tip_in_marker) {
    corrected_guide_ = geometry(guide());
    corrected_guide_->tip_in_marker = tip_in_marker;
  }
  /// Likewise its axis.
  void correct_guide_axis(Direction<Marker> axis_in_marker) {
    corrected_guide_ = geometry(guide());
    corrected_guide_->axis_in_marker = axis_in_marker;
  }
  /// The pointer's tip as last measured, no longer than `within` before `now`.
  [[nodiscard]] std::optional<Point<World>> pointer_tip(Timestamp now, Duration within) const;
  /// The fraction by which a tag is larger than its tool's definition says, which makes poses
  /// wrong. Absent if all is well.
  [[nodiscard]] std::optional<double> tag_size_off(std::size_t tool) const;
  /// The two pictures of the newest pairs are not of the same moment, or the cameras were just
  /// turned against each other.
  [[nodiscard]] bool pictures_apart() const;
  /// SD of the size difference between the tags of pointer and guide, as a fraction.
  [[nodiscard]] double tag_size_difference_sd() const;

  [[nodiscard]] std::span<const nav::ToolState> states() const { return states_; }
  [[nodiscard]] std::span<const ToolSight> sights() const { return sights_; }
  [[nodiscard]] const nav::ToolTracker& tracker() const { return *tracker_; }

 private:
  WatchedTools(std::unique_ptr<nav::ToolTracker> tracker, std::size_t pointer,
               std::optional<std::size_t> guide);
  void note(std::span<const nav::ToolState> states);

  std::unique_ptr<nav::ToolTracker> tracker_;
  std::optional<nav::ToolGeometry> corrected_guide_;
  std::size_t pointer_ = 0;
  std::optional<std::size_t> guide_;
  std::span<const nav::ToolState> states_;
  std::vector<ToolWatch> watches_;
  std::vector<ToolSight> sights_;
};

}  // namespace orthonav::engine
