#pragma once

#include "engine/holograms/hologram_cross.h"
#include "engine/holograms/hologram_twin.h"
#include "engine/holograms/visibility.h"
#include "engine/session/guidance.h"

namespace orthonav::engine {

// What the holograms of the selected screw are made of, for whoever draws or tells them.

/// The planned trajectory in the world: its outer end, the entry, the target.
struct TrajectoryLine {
  Point<World> outside;
  Point<World> entry;
  Point<World> target;
};
[[nodiscard]] TrajectoryLine trajectory_of(const PlacedScrew& screw);

/// A wire as it was measured, in the world: its outer end, abreast of the entry, as deep as
/// planned.
[[nodiscard]] TrajectoryLine line_of(const PlacedWire& wire, const PlacedScrew& screw);
/// That, beside H4; `text` is room for its words.
void add_wire(render::Scene& scene, const PlacedScrew& screw, const PlacedWire& wire,
              std::string& text);

/// Of a visible H5 and its H6. What is only predicted has no number and is never called good.
[[nodiscard]] Grade grade_of_tool(const Visibility& visible, const VisibilityRules& rules);

/// H7 over the level's site.
[[nodiscard]] TargetCross cross_of(const PlacedScrew& screw, const VisibleCross& visible,
                                   const VisibilityRules& rules);

/// The side of the site on which H7 hangs clear of the tool.
[[nodiscard]] LabelSide clear_side_of(const PlacedScrew& screw, const Transform<World, Rig>& head,
                                      LabelSide until_now);

/// H8 on the side that the screw is not on, clear of the hand.
[[nodiscard]] VirtualTwin twin_of(const PlacedScrew& screw);

}  // namespace orthonav::engine
