#include "render/thinned.h"

#include <algorithm>
#include <limits>

#include "render/float3.h"

namespace orthonav::render {
namespace {

constexpr float kGentleCosine = 0.97f;  // 14 degrees; line.vert closes a gap of that size
constexpr float kLeastSeen = 0.5f;      // of a length, when foreshortened
constexpr std::size_t kLongestRun = 8;

/// How far the line may miss a point, squared.
float squared_slack(Float3 p, std::span<const Float3> eyes, float angle_rad) {
  float nearest = std::numeric_limits<float>::max();
  for (const Float3 eye : eyes) {
    nearest = std::min(nearest, dot(p - eye, p - eye));
  }
  return angle_rad * angle_rad * nearest;
}

}  // namespace

void thin(std::span<const Float3> points, std::span<const Float3> eyes, float angle_rad,
          std::vector<Float3>& kept) {
  kept.clear();
  if (!(angle_rad > 0)) {
    kept.insert(kept.end(), points.begin(), points.end());
    return;
  }
  append_needed(
      points, kLongestRun,
      [&](Float3 p, Float3 a, Float3 b) {
        return squared_distance_to_segment(p, a, b) <= squared_slack(p, eyes, angle_rad);
      },
      kept);
}

bool bends_gently(Float3 a, Float3 b, Float3 c, std::span<const Float3> eyes) {
  const Float3 before = b - a;
  const Float3 after = c - b;
  return std::all_of(eyes.begin(), eyes.end(), [&](Float3 eye) {
    const Float3 ray = unit_or(b - eye, {0, 0, 1});
    const Float3 seen_before = before - dot(before, ray) * ray;
    const Float3 seen_after = after - dot(after, ray) * ray;
    const float length_before = length(seen_before);
    const float length_after = length(seen_after);
    return length_before > kLeastSeen * length(before) &&
           length_after > kLeastSeen * length(after) &&
           dot(seen_before, seen_after) > kGentleCosine * length_before * length_after;
  });
}

}  // namespace orthonav::render
