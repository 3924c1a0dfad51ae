#pragma once

#include <optional>
#include <vector>

#include "base/random.h"
#include "engine/study/measurement_model.h"
#include "hal/sim/sim_headset.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::engine {

/// A tag's corners in the image of a camera; nothing where it can't be found there.
struct ModelledSighting {
  std::optional<nav::TagCorners> left_px;
  std::optional<nav::TagCorners> right_px;
};

/// Where the two cameras of a simulated room see its tools: the true corners through the cameras as
/// they are, with the errors of a measurement model. Draws from a stream of its own, by pair and
/// tool, so that what is asked when changes nothing.
class ModelledSightings {
 public:
  /// The room must outlive it.
  ModelledSightings(const sim::SimHeadset& room, const MeasurementModel& model);

  /// The state of the room is that of the pair.
  void look(const StereoFrame& frame);
  /// In the order of the room's tools.
  [[nodiscard]] const std::vector<ModelledSighting>& seen() const { return seen_; }
  /// Where the tool is, for a solver to start from; nothing where neither camera sees it.
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
  /// `worse`: by how much a drop on the tag makes its errors grow.
  std::optional<nav::TagCorners> with_errors(const std::optional<nav::TagCorners>& exact,
                                             nav::TagCorners& lasting,
                                             std::optional<nav::TagCorners>& before, Random& random,
                                             double dt_s, double worse) const;

  const sim::SimHeadset* room_;
  MeasurementModel model_;
  Random random_;
  std::vector<Trail> trails_;
  std::vector<ModelledSighting> seen_;
  std::vector<Transform<Rig, Marker>> near_;
  Timestamp before_{};
};

}  // namespace orthonav::engine
