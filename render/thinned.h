#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "render/scene.h"

namespace orthonav::render {

/// The points of a line without those that a straight segment can replace: from each kept point,
/// the segment reaches as far as `stands_for(p, from, to)` holds for all points between. At most
/// `longest_run` points in a row are left out, which bounds the work. The kept points are appended;
/// the first and the last are always kept.
template <class StandsFor>
void append_needed(std::span<const Float3> points, std::size_t longest_run,
                   const StandsFor& stands_for, std::vector<Float3>& kept) {
  for (std::size_t from = 0; from < points.size();) {
    kept.push_back(points[from]);
    std::size_t to = from + 1;
    const auto reaches = [&](std::size_t end) {
      const auto between = points.subspan(from + 1, end - from - 1);
      return std::all_of(between.begin(), between.end(),
                         [&](Float3 p) { return stands_for(p, points[from], points[end]); });
    };
    while (to + 1 < points.size() && to - from <= longest_run && reaches(to + 1)) {
      ++to;
    }
    from = to;
  }
}

/// The points of a line without those whose absence is not visible: as seen from each eye, every
/// point left out lies within the angle (in radians) of the line that remains. The first and the
/// last are kept.
void thin(std::span<const Float3> points, std::span<const Float3> eyes, float angle_rad,
          std::vector<Float3>& kept);

/// Whether the line a-b-c bends so little at b, as seen from all eyes, that the ends of its two
/// segments need no rounding there, either because of the bend or because a segment points at an
/// eye.
[[nodiscard]] bool bends_gently(Float3 a, Float3 b, Float3 c, std::span<const Float3> eyes);

}  // namespace orthonav::render
