#pragma once

#include <optional>
#include <vector>

#include "base/random.h"
#include "hal/sim/cameras/tag_occlusion.h"
#include "hal/sim/sim_headset.h"
#include "study/corner_pose.h"
#include "study/measurement_model.h"

namespace orthonav::engine {

/// Where the two cameras of a simulated room see its tools: the true corners of tags that nothing
/// hides through the true cameras, with the errors of a measurement model. Draws from a separate
/// stream per pair and tool, so that the order of queries does not matter.
class ModelledSightings {
 public:
  /// The room must outlive it.
  ModelledSightings(const sim::SimHeadset& room, const MeasurementModel& model);

  /// Looks at a pair; the state of the room must be that of the pair.
  void look(const StereoFrame& frame);
  /// In the order of the room's tools.
  [[nodiscard]] const std::vector<StereoCorners>& seen() const { return seen_; }
  /// Where the tool is, as a start for a solver; nothing if neither camera sees it.
  [[nodiscard]] std::optional<Transform<Rig, Marker>> near(std::size_t tool) const;

 private:
  struct Errors {
    nav::TagCorners left_px{};
    nav::TagCorners right_px{};
  };
  struct Trail {
    Errors lasting;
    std::optional<nav::TagCorners> before_left;
    std::optional<nav::TagCorners> before_right;
  };
  void look_at(std::size_t tool, const StereoFrame& frame, const sim::RoomState& now);
  /// Whether it mirrors the lamp into the cameras.
  [[nodiscard]] bool is_blinded(std::size_t tool, const sim::RoomState& now) const;
  /// `worse`: factor on the errors from a drop on the tag.
  std::optional<nav::TagCorners> with_errors(const std::optional<nav::TagCorners>& exact,
                                             nav::TagCorners& lasting,
                                             std::optional<nav::TagCorners>& before, Random& random,
                                             double dt_s, double worse) const;

  const sim::SimHeadset* room_;
  MeasurementModel model_;
  Random random_;
  sim::TagOcclusion left_;
  sim::TagOcclusion right_;
  std::vector<Trail> trails_;
  std::vector<StereoCorners> seen_;
  std::vector<Transform<Rig, Marker>> near_;
  Timestamp before_{};
};

}  // namespace orthonav::engine
