#pragma once

#include <span>

#include "base/transform.h"

namespace orthonav::nav {

/// The geometric median of relative poses, which minimizes the sum of distances to them
/// (Weiszfeld's algorithm on rotations and translations: Hartley, Trumpf, Dai & Li 2013, "Rotation
/// averaging"), so wrong ones hardly move it if they are fewer than half. A rotation of 1 rad
/// counts as a translation of 50 mm, since it moves a tag's corners by about that much. There must
/// be at least one pose.
[[nodiscard]] Transform<Tag, Tag> median_pose(std::span<const Transform<Tag, Tag>> poses);

}  // namespace orthonav::nav
