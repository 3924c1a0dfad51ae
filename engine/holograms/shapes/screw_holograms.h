#pragma once

#include "engine/holograms/shapes/hologram_cross.h"
#include "engine/holograms/shapes/hologram_twin.h"
#include "engine/holograms/visibility.h"
#include "engine/session/guidance.h"

namespace orthonav::engine {

// Geometry of the selected screw's holograms, for drawing and for the frame in words.

/// The planned trajectory in the world: its outer end, the entry, the target.
struct TrajectoryLine {
  Point<World> outside;
  Point<World> entry;
  Point<World> target;
};
[[nodiscard]] TrajectoryLine trajectory_of(const PlacedScrew& screw);

/// A measured wire in the world: its outer end, its point abreast of the entry, and its point at
/// the planned depth.
[[nodiscard]] TrajectoryLine line_of(const PlacedWire& wire, const PlacedScrew& screw);
/// Adds it beside H4; `text` is a buffer for its words.
void add_wire(render::Scene& scene, const PlacedScrew& screw, const PlacedWire& wire,
              std::string& text);

/// The middle of the level's entry points.
[[nodiscard]] Point<World> site_of(const PlacedLevel& at);

/// H7 over the level's site, and what is written under it.
[[nodiscard]] TargetCross cross_of(const PlacedScrew& screw, const Visibility& visible);
[[nodiscard]] CrossNumbers cross_numbers_of(const Visibility& visible);

/// The side of the site on which H7 is clear of the tool.
[[nodiscard]] LabelSide clear_side_of(const PlacedScrew& screw, const Transform<World, Rig>& head,
                                      LabelSide until_now);

/// H8 on the side opposite to the screw, clear of the hand.
[[nodiscard]] VirtualTwin twin_of(const PlacedScrew& screw);

}  // namespace orthonav::engine
