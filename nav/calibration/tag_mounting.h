#pragma once

#include <span>
#include <vector>

#include "nav/calibration/tag_body.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

/// A tag that sits on its tool turned about its own middle, against the tool's description.
struct RotatedTag {
  MarkerDefinition definition;
  int quarter_turns = 0;  ///< 1, 2 or 3 times 90°, counter-clockwise as one looks at its face
};

/// Which tags of a measured body were glued on turned by quarters, the marker itself included: tags
/// are square, so a hand that mounts them errs by quarters. The marker's own turn shows in where
/// the other tags lie from it. Tags that `described` does not hold are left out; a layout that
/// quarters do not bring within 30° and 30 mm of the described one is another layout, and gives
/// none.
[[nodiscard]] std::vector<RotatedTag> rotated_tags(std::span<const BodyTag> measured,
                                                   std::span<const AttachedMarker> described);

}  // namespace orthonav::nav
