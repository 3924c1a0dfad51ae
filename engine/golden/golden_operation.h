#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/golden/golden_stage.h"
#include "engine/holograms/visibility.h"
#include "engine/session/coach.h"
#include "engine/session/guidance.h"

namespace orthonav::engine::golden {

/// The golden patient's operation as the session hands it to the display: L4 with both screws, the
/// right one done. Pictures of steps are drawn from it by the product's own scene builder.
class StagedOperation {
 public:
  explicit StagedOperation(Step step);
  StagedOperation(const StagedOperation&) = delete;
  StagedOperation& operator=(const StagedOperation&) = delete;
  ~StagedOperation() = default;

  /// The guide as measured, with what the session derives from it.
  void measure(const nav::ScrewGuidance& tool, const NumberSds& sds = {});
  /// It is only predicted, or lost.
  void predict(const nav::ScrewGuidance& tool);
  void lose();
  /// The surgeon's eyes.
  void look_from(const Viewer& viewer);

  /// What a frame shows of it, for these views; laid out with the other golden scenes.
  [[nodiscard]] GoldenScene scene(const std::string& name, const std::string& what,
                                  std::vector<render::View> views = surgeon_views()) const;

  Guidance guidance;
  VisibilityRules rules;
  /// Where the eyes have rested long enough; absent: it is not known.
  std::optional<render::Float3> rests_on;
  LevelState& level() { return levels_.front(); }
  std::vector<nav::Region> regions;
  std::vector<float> residuals_m;
  std::vector<Point<World>> to_check;
  nav::CheckVerdict verdict;
  Coaching coaching;

 private:
  std::vector<LevelState> levels_;
  std::vector<ToolSight> tools_;
};

}  // namespace orthonav::engine::golden
