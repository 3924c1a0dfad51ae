#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nav/tracking/tool_tracker.h"

namespace orthonav::test {

/// A tracker whose tool poses for the next pairs are set by the test; absent: not seen.
class ScriptedTracker : public nav::ToolTracker {
 public:
  ScriptedTracker();
  std::span<const nav::ToolState> track(const StereoFrame& frame) override;
  [[nodiscard]] std::span<const nav::ToolGeometry> tools() const override { return tools_; }

  std::optional<Transform<World, Marker>> pointer;
  std::optional<Transform<World, Marker>> guide;
  /// The status of the poses above.
  PoseStatus pointer_origin = PoseStatus::kMeasured;
  PoseStatus guide_origin = PoseStatus::kMeasured;
  /// From now on there is a patient reference, seen in every pair until the test changes that.
  void hang_on_reference();
  bool reference_seen = true;
  std::optional<Transform<World, Marker>> reference_pose;  ///< absent: not reported
  nav::Anchor reference;                                   ///< its reported state
  std::optional<nav::TagSize> size;                        ///< of every tool
  /// There is no guide; call before anything is added and before the session is made.
  void has_pointer_alone();
  /// Adds a further tool, after the others; call before the session is made.
  void add_other(const nav::ToolGeometry& tool);
  std::optional<Transform<World, Marker>> other;  ///< the pose of that tool
  [[nodiscard]] nav::ToolGeometry& guide_tool() { return tools_[1]; }
  [[nodiscard]] std::optional<nav::TagSize> tag_size(std::size_t /*tool*/) const override {
    return size;
  }
  double size_difference_sd = 0.0;  ///< of two tools' tags, as a fraction
  [[nodiscard]] double tag_size_difference_sd(std::size_t /*tool*/,
                                              std::size_t /*other*/) const override {
    return size_difference_sd;
  }
  [[nodiscard]] const nav::Anchor* anchor() const override {
    return hangs_on_reference_ ? &reference : nullptr;
  }

 private:
  std::vector<nav::ToolGeometry> tools_;
  std::vector<nav::ToolState> states_;
  bool hangs_on_reference_ = false;
};

/// A guide whose tip is at `tip` and whose shaft leaves the bone at `angle_rad` from +y, about z.
Transform<World, Marker> guide_at(Vec3 tip, double angle_rad);
/// A pointer with its tip there.
Transform<World, Marker> pointer_at(Vec3 tip);

}  // namespace orthonav::test
