#pragma once

#include <span>
#include <vector>

#include "render/scene.h"

namespace orthonav::render {

/// The points of a line without those that nobody sees missing: every one left out lies, as seen
/// from each eye, within the angle (in radians) of the line that remains. The first and the last
/// stay.
void thin(std::span<const Float3> points, std::span<const Float3> eyes, float angle_rad,
          std::vector<Float3>& kept);

/// Whether the line a-b-c bends so little at b, as all eyes see it, that the ends of its two parts
/// need no rounding there: neither because of the bend nor because a part points at an eye.
[[nodiscard]] bool bends_gently(Float3 a, Float3 b, Float3 c, std::span<const Float3> eyes);

}  // namespace orthonav::render
