#pragma once

#include <span>
#include <vector>

#include "nav/calibration/tag_body.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

/// A tag that is mounted on its tool turned about its own middle, compared with the tool's
/// description.
struct TurnedTag {
  MarkerDefinition definition;
  int quarter_turns = 0;  ///< 1, 2 or 3 times 90°, counter-clockwise as one looks at its face
};

/// Which tags of a measured body, including the marker, were glued on turned by quarter turns: tags
/// are square, so mounting mistakes are quarter turns. The marker's own turn shows in the places of
/// the other tags relative to it. Tags that `described` does not hold are left out. If no quarter
/// turns bring the layout within 30° and 30 mm of the described one, it is a different layout, and
/// the result is empty.
[[nodiscard]] std::vector<TurnedTag> turned_tags(std::span<const BodyTag> measured,
                                                 std::span<const AttachedMarker> described);

}  // namespace orthonav::nav
