#pragma once

#include <cstddef>
#include <optional>

#include "engine/session/guidance.h"
#include "engine/session/tool_in_vertebra.h"
#include "engine/session/tool_watch.h"

namespace orthonav::engine {

/// The step in which screws are guided: which one, and by what.
class Guiding {
 public:
  explicit Guiding(const nav::DrillLimits& limits = {}) : drill_(limits) {}

  /// The level's first screw that is not done, or its first.
  void select_open_screw(const LevelState& level);
  /// Another level: what guided on the one before has no part in it.
  void begin_level();
  /// Nothing guided so far holds any more; the screw stays selected.
  void forget_guidance();
  /// What rests on the last pair's measurement goes: in this one there is none.
  void lose_measurement();
  /// The surgeon says so.
  void begin_drill() { drill_.begin(); }
  void toggle_twin() { twin_ = !twin_; }

  /// How far the tool may be off, from now on; World's walk is the level's (BoneFound).
  void know_errors(const ToolErrors& errors) { errors_ = errors; }

  /// The tool against the selected screw. Absent where nothing fresh is there to guide on.
  [[nodiscard]] std::optional<ToolGuidance> guide(const LevelState& level, const ToolWatch& watch,
                                                  const nav::ToolGeometry& tool, Timestamp now,
                                                  Timestamp display_time, Duration stale_after);

  [[nodiscard]] std::size_t screw() const { return screw_; }
  [[nodiscard]] bool twin() const { return twin_; }
  /// The last measurement with the tool at its greatest depth along the selected screw, or null.
  /// Poses after the tool was withdrawn do not count.
  [[nodiscard]] const ToolGuidance* at_depth() const { return at_depth_ ? &*at_depth_ : nullptr; }
  /// Of the selected screw if it were driven along the tool's axis; none where the tool is not held
  /// near the plan (15 mm, 30°). Of the pose's uncertainty and the registration's, where there is
  /// one. What shifts bone and tool alike counts in full: the hand and the drill go astray
  /// as well, and a bound may be too careful, never too hopeful. Allocates nothing.
  [[nodiscard]] std::optional<nav::ScrewClearance> clearance_along(
      const LevelState& level, const nav::TrackedPose& pose, const nav::ToolGeometry& tool) const;
  /// That, and as it is written, into guidance on a measurement.
  void add_clearance(ToolGuidance& guidance, const LevelState& level, const nav::TrackedPose& pose,
                     const nav::ToolGeometry& tool);
  /// The same of the measurement of `at_depth`.
  [[nodiscard]] std::optional<nav::ScrewClearance> clearance_at_depth(
      const LevelState& level, const nav::ToolGeometry& tool) const;
  [[nodiscard]] const nav::DrillView& drill() const { return drill_.view(); }
  /// Where the tool went at the selected screw; none where it was not measured there.
  [[nodiscard]] std::optional<nav::ExecutedTrajectory> executed() const { return path_.mean(); }
  [[nodiscard]] StepState state(const LevelState& level) const;

 private:
  /// Takes the tool as it was measured in this pair to numbers, drill and path.
  void take_measurement(ToolGuidance& guidance, const LevelState& level,
                        const nav::TrackedPose& pose, const nav::ToolGeometry& tool);
  void remember_depth(const ToolGuidance& guidance, const nav::ScrewGuidance& measured,
                      const nav::TrackedPose& pose);

  [[nodiscard]] ToolInVertebra in_bone(const LevelState& level, const nav::TrackedPose& pose,
                                       const nav::ToolGeometry& tool) const;

  ToolErrors errors_;
  std::size_t screw_ = 0;
  std::optional<ToolGuidance> at_depth_;
  nav::TrackedPose pose_at_depth_;  ///< of the tool, where there is an `at_depth_`
  double deepest_m_ = 0.0;          ///< the greatest depth past the entry so far
  nav::ScrewNumberWriter numbers_;
  nav::ClearanceWriter clearance_;
  nav::DrillWatch drill_;
  nav::TrajectoryAtDepth path_;
  bool twin_ = false;
};

}  // namespace orthonav::engine
