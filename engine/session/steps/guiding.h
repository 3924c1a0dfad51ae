#pragma once

#include <cstddef>
#include <optional>

#include "engine/session/operation_in_work.h"
#include "engine/session/tool_in_vertebra.h"

namespace orthonav::engine {

class GuideChecks;
class Placing;

/// The step in which screws are guided.
class Guiding {
 public:
  explicit Guiding(const nav::DrillLimits& limits = {}) : limits_(limits), approach_(limits) {}

  /// Selects the level's first screw that is not done, or its first.
  void select_open_screw(const LevelState& level);
  /// Another level begins: guidance of the previous one no longer applies.
  void begin_level();
  /// All guidance so far is void; the screw stays selected.
  void forget_guidance() { approach_ = Approach(limits_); }
  /// The tool was not measured in this pair: drops what was based on the last measurement.
  void lose_measurement();
  /// The surgeon said "drill".
  void begin_drill() { approach_.drill.begin(); }
  void toggle_twin() { twin_ = !twin_; }
  void toggle_numbers() { numbers_ = !numbers_; }
  /// The selected screw is done, with its wire where one was placed.
  [[nodiscard]] Event finish_screw(OperationInWork& work, const Placing& placing,
                                   Timestamp time) const;

  [[nodiscard]] std::size_t screw() const { return screw_; }
  [[nodiscard]] const nav::DrillView& drill() const { return approach_.drill.view(); }
  /// Clearance of the selected screw if it were driven along the tool's axis; none if the tool is
  /// not near the plan (15 mm, 30°). Where the registration's uncertainty is known, takes the
  /// tool's relative to the bone into account, and how far a drill goes astray (`DrillAstray`).
  /// Allocates nothing.
  [[nodiscard]] std::optional<nav::ScrewClearance> clearance_along(const LevelState& level,
                                                                   const nav::TrackedPose& pose,
                                                                   const nav::ToolGeometry& tool,
                                                                   const DrillAstray& astray) const;
  /// Writes the selected screw and, in this step, the tool relative to it unless guidance is
  /// hidden.
  void write(const OperationInWork& work, const GuideChecks& checks, bool hidden, Guidance& out);

 private:
  /// What was measured on the way to the selected screw.
  struct Approach {
    explicit Approach(const nav::DrillLimits& limits) : drill(limits) {}

    /// The last measurement with the tool at its greatest depth along the screw. Poses after its
    /// withdrawal do not count.
    std::optional<ToolGuidance> at_depth;
    nav::TrackedPose pose_at_depth;  ///< of the tool, if there is an `at_depth`
    double deepest_m = 0.0;          ///< the greatest depth past the entry so far
    nav::ScrewNumberWriter numbers;
    nav::ScrewSizeWriter sizes;
    nav::DepthWriter depth;
    nav::ClearanceWriter clearance;
    nav::DrillWatch drill;
    bool drilled = false;  ///< since the approach began
    bool was_set = false;  ///< on the bone at the entry, or drilled
    nav::TrajectoryAtDepth path;

    /// Feeds the drill's watch. The first time that the tip is set on the bone at the entry, what
    /// was measured on the way there is forgotten: beside the screw a tip may lie deeper than where
    /// it is set, as in the dimple, and a sleeve never gets deeper than there.
    void watch_drill(const nav::DrillReading& reading);
  };

  /// The tool relative to the selected screw. Absent without a fresh pose to guide on.
  [[nodiscard]] std::optional<ToolGuidance> guide(const OperationInWork& work, Timestamp now,
                                                  Timestamp display_time);
  /// Feeds the tool's pose measured in this pair to numbers, drill and path.
  void take_measurement(ToolGuidance& guidance, const LevelState& level,
                        const nav::TrackedPose& pose, const nav::ToolGeometry& tool);
  void remember_depth(const ToolGuidance& guidance, const nav::ScrewGuidance& measured,
                      const nav::TrackedPose& pose);
  [[nodiscard]] ToolInVertebra in_bone(const LevelState& level, const nav::TrackedPose& pose,
                                       const nav::ToolGeometry& tool) const;
  /// Adds `clearance_along`, and its displayed form, to guidance on a measurement.
  void add_clearance(ToolGuidance& guidance, const OperationInWork& work,
                     const nav::TrackedPose& pose, const nav::ToolGeometry& tool);

  nav::DrillLimits limits_;
  ToolErrors errors_;  ///< of the tool in this pair; World's drift is in the level (BoneFound)
  std::size_t screw_ = 0;
  Approach approach_;
  bool twin_ = false;
  bool numbers_ = false;
};

}  // namespace orthonav::engine
