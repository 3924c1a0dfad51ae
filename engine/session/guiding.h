#pragma once

#include <cstddef>
#include <optional>

#include "engine/session/operation_in_work.h"
#include "engine/session/tool_in_vertebra.h"

namespace orthonav::engine {

class GuideChecks;
class Placing;

/// The step in which screws are guided: which one, and by what.
class Guiding {
 public:
  explicit Guiding(const nav::DrillLimits& limits = {}) : limits_(limits), approach_(limits) {}

  /// The level's first screw that is not done, or its first.
  void select_open_screw(const LevelState& level);
  /// Another level: what guided on the one before has no part in it.
  void begin_level();
  /// Nothing guided so far holds any more; the screw stays selected.
  void forget_guidance() { approach_ = Approach(limits_); }
  /// What rests on the last pair's measurement goes: in this one there is none.
  void lose_measurement();
  /// The surgeon says so.
  void begin_drill() { approach_.drill.begin(); }
  void toggle_twin() { twin_ = !twin_; }
  /// The selected screw is done, with its wire where one was placed.
  [[nodiscard]] Event finish_screw(OperationInWork& work, const Placing& placing,
                                   Timestamp time) const;

  [[nodiscard]] std::size_t screw() const { return screw_; }
  [[nodiscard]] const nav::DrillView& drill() const { return approach_.drill.view(); }
  /// Of the selected screw if it were driven along the tool's axis; none where the tool is not held
  /// near the plan (15 mm, 30°). Of the pose's uncertainty and the registration's, where there is
  /// one. What shifts bone and tool alike counts in full: the hand and the drill go astray
  /// as well, and a bound may be too careful, never too hopeful. Allocates nothing.
  [[nodiscard]] std::optional<nav::ScrewClearance> clearance_along(
      const LevelState& level, const nav::TrackedPose& pose, const nav::ToolGeometry& tool) const;
  /// The selected screw, and in the step the tool against it, unless guidance is hidden.
  void write(const OperationInWork& work, const GuideChecks& checks, bool hidden, Guidance& out);
  [[nodiscard]] StepState state(const LevelState& level) const;

 private:
  /// What was measured on the way to the selected screw.
  struct Approach {
    explicit Approach(const nav::DrillLimits& limits) : drill(limits) {}

    /// The last measurement with the tool at its greatest depth along the screw. Poses after the
    /// tool was withdrawn do not count.
    std::optional<ToolGuidance> at_depth;
    nav::TrackedPose pose_at_depth;  ///< of the tool, where there is an `at_depth`
    double deepest_m = 0.0;          ///< the greatest depth past the entry so far
    nav::ScrewNumberWriter numbers;
    nav::ClearanceWriter clearance;
    nav::DrillWatch drill;
    nav::TrajectoryAtDepth path;
  };

  /// The tool against the selected screw. Absent where nothing fresh is there to guide on.
  [[nodiscard]] std::optional<ToolGuidance> guide(const OperationInWork& work, Timestamp now,
                                                  Timestamp display_time);
  /// Takes the tool as it was measured in this pair to numbers, drill and path.
  void take_measurement(ToolGuidance& guidance, const LevelState& level,
                        const nav::TrackedPose& pose, const nav::ToolGeometry& tool);
  void remember_depth(const ToolGuidance& guidance, const nav::ScrewGuidance& measured,
                      const nav::TrackedPose& pose);
  [[nodiscard]] ToolInVertebra in_bone(const LevelState& level, const nav::TrackedPose& pose,
                                       const nav::ToolGeometry& tool) const;
  /// `clearance_along`, and as it is written, into guidance on a measurement.
  void add_clearance(ToolGuidance& guidance, const LevelState& level, const nav::TrackedPose& pose,
                     const nav::ToolGeometry& tool);

  nav::DrillLimits limits_;
  ToolErrors errors_;  ///< of the tool in this pair; World's walk is the level's (BoneFound)
  std::size_t screw_ = 0;
  Approach approach_;
  bool twin_ = false;
};

}  // namespace orthonav::engine
