#pragma once

#include "engine/holograms/hologram_cross.h"
#include "engine/holograms/hologram_twin.h"
#include "engine/holograms/shown_frame.h"
#include "engine/holograms/visibility.h"
#include "engine/session/guidance.h"

namespace orthonav::engine {

// What the holograms of the selected screw are made of, for whoever draws or tells them.

/// Of H5 and H6. What is only predicted has no number and is never called good.
[[nodiscard]] Grade grade_of_tool(const Guidance& guidance, const Visibility& visible,
                                  const VisibilityRules& rules);

/// H7 over the level's site; the guidance knows the head.
[[nodiscard]] TargetCross cross_of(const Guidance& guidance, const Visibility& visible,
                                   const VisibilityRules& rules);

/// The side of the site on which H7 hangs clear of the tool.
[[nodiscard]] LabelSide clear_side_of(const LevelState& level, std::size_t screw,
                                      const Transform<World, Rig>& head, LabelSide until_now);

/// H8 on the side that the selected screw is not on, clear of the hand.
[[nodiscard]] VirtualTwin twin_of(const LevelState& level, std::size_t screw);

}  // namespace orthonav::engine
