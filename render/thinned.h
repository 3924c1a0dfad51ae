#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "render/scene.h"

namespace orthonav::render {

/// The points of a line without those that a straight piece stands for: from each point kept as far
/// on as `stands_for(p, from, to)` holds for all points between. At most `longest_run` in a row are
/// left out, which bounds the work. What is kept is appended; the first and the last stay.
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

/// The points of a line without those that nobody sees missing: every one left out lies, as seen
/// from each eye, within the angle (in radians) of the line that remains. The first and the last
/// stay.
void thin(std::span<const Float3> points, std::span<const Float3> eyes, float angle_rad,
          std::vector<Float3>& kept);

/// Whether the line a-b-c bends so little at b, as all eyes see it, that the ends of its two parts
/// need no rounding there: neither because of the bend nor because a part points at an eye.
[[nodiscard]] bool bends_gently(Float3 a, Float3 b, Float3 c, std::span<const Float3> eyes);

}  // namespace orthonav::render
