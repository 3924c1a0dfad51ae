#include <utility>

#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/screw_holograms.h"

namespace orthonav::engine {

/// Hangs H7 beside the place that the eyes rest on.
void SceneBuilder::hang_cross(const Guidance& guidance, Timestamp display_time) {
  if (!visible_.cross || !visible_.trajectory) {
    return;
  }
  const PlacedScrew& screw = *visible_.trajectory;
  if (const std::pair of(screw.at.level, screw.screw); hung_for_ != of) {
    hung_for_ = of;
    gaze_anchor_.reset();
  }
  std::optional<Gaze> gaze = gaze_;
  if (gaze && guidance.anchor) {
    const auto anchored_from_world = guidance.anchor->world_from_anchored.inverse();
    gaze->origin = anchored_from_world * gaze->origin;
    gaze->direction = anchored_from_world * gaze->direction;
  }
  VisibleCross& cross = *visible_.cross;
  cross.aside = gaze_anchor_.follow({site_of(screw.at), screw.at.world_from_vertebra,
                                     cross.world_from_head, cross.side, visible_.entries_of},
                                    gaze, display_time);
}

}  // namespace orthonav::engine
