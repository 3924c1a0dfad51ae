#pragma once

#include <span>

#include "base/transform.h"

namespace orthonav::nav {

/// The geometric median of relative poses: the sum of distances to it is least (Weiszfeld's
/// algorithm on rotations and shifts: Hartley, Trumpf, Dai & Li 2013, "Rotation averaging"), so
/// that wrong ones, fewer than half, hardly move it. A turn of 1 rad counts as a shift of 50 mm,
/// which is what it moves a tag's corners by. There must be one at least.
[[nodiscard]] Transform<Tag, Tag> median_pose(std::span<const Transform<Tag, Tag>> poses);

}  // namespace orthonav::nav
